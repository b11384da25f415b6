//! An interpreter of URScript, as far as programs need it, and an emulated arm that it drives. It knows the language and the rules of the arm, and
//! nothing of the templates.

use super::cell::{inverse, product, towards, turn_from};
use super::tokens::{Line, Reader, Token, lines};
use plydrape::geometry::vector::{distance, norm, turned};
use plydrape::mold::Pose;
use std::collections::BTreeMap;
use std::rc::Rc;

#[derive(Debug, Clone, PartialEq)]
enum Value {
    Number(f64),
    Bool(bool),
    List(Vec<f64>),
    Pose(Pose),
    Text,
    Nothing,
}

impl Value {
    fn number(&self) -> f64 {
        match self {
            Value::Number(number) => *number,
            other => panic!("{other:?} is no number"),
        }
    }

    fn bool(&self) -> bool {
        match self {
            Value::Bool(value) => *value,
            other => panic!("{other:?} is no truth value"),
        }
    }

    fn pose(&self) -> Pose {
        match self {
            Value::Pose(pose) => *pose,
            other => panic!("{other:?} is no pose"),
        }
    }
}

#[derive(Debug)]
enum Expression {
    Constant(Value),
    Name(String),
    Call(String, Vec<Expression>),
    Index(String, usize),
    List(Vec<Expression>),
    Not(Box<Expression>),
    Pair(Box<Expression>, &'static str, Box<Expression>),
}

#[derive(Debug)]
enum Statement {
    Set { name: String, local: bool, value: Expression },
    Do(Expression),
    If(Expression, Vec<Statement>, Vec<Statement>),
    While(Expression, Vec<Statement>),
    Return(Expression),
    Define(String, Rc<Function>),
    Halt,
}

#[derive(Debug)]
struct Function {
    parameters: Vec<String>,
    body: Vec<Statement>,
}

/// How a statement ended.
enum Ended {
    On,
    With(Value),
    Halted,
}

/// One step of the controller.
#[derive(Debug, Clone)]
pub struct Moment {
    pub time: f64,
    /// The center of the tool in the base of the robot.
    pub arm: Pose,
    /// Float output register 0.
    pub register: f64,
    /// How many outputs are on, but for those of the array.
    pub vacuum: usize,
}

/// An arm that follows `servoj` late, and slower by the slider, and everything that its program has done.
pub struct Arm {
    /// Slider over time (s), from 0 to 1; 0 is a pause or a protective stop.
    pub slider: Box<dyn Fn(f64) -> f64>,
    pub step: f64,
    pub moments: Vec<Moment>,
    pub halted: bool,
    /// What a popup said.
    pub said: usize,
    arm: Pose,
    tool_speed: f64,
    time: f64,
    register: f64,
    outputs: BTreeMap<(String, usize), bool>,
    globals: BTreeMap<String, Value>,
    functions: BTreeMap<String, Rc<Function>>,
}

/// Lag of the arm behind what `servoj` asks for (s), with the lookahead of 0.05 s.
const LAG: f64 = 0.06;
/// How fast it goes at most at full speed (m/s).
const SPEED: f64 = 0.5;

impl Arm {
    pub fn new(slider: impl Fn(f64) -> f64 + 'static) -> Self {
        Arm {
            slider: Box::new(slider),
            step: 0.002,
            moments: Vec::new(),
            halted: false,
            said: 0,
            arm: Pose::ORIGIN,
            tool_speed: 0.0,
            time: 0.0,
            register: 0.0,
            outputs: BTreeMap::new(),
            globals: BTreeMap::new(),
            functions: BTreeMap::new(),
        }
    }

    /// Loads texts one after the other and runs a function of theirs.
    pub fn run(&mut self, texts: &[&str], name: &str) {
        for text in texts {
            let mut lines: Vec<Line> = lines(text, "#", 400);
            lines.reverse();
            while !lines.is_empty() {
                let statement = statement(&mut lines);
                self.execute(&statement, &mut BTreeMap::new());
            }
        }
        self.call(name, Vec::new());
        self.advance(None, self.step);
    }

    fn advance(&mut self, target: Option<Pose>, seconds: f64) {
        let steps = (seconds / self.step).round().max(1.0) as usize;
        for _ in 0..steps {
            let before = self.arm;
            if let Some(target) = target {
                let slider = (self.slider)(self.time);
                let share = slider * (1.0 - (-self.step / LAG).exp());
                let most =
                    slider * SPEED * self.step / distance(self.arm.position, target.position);
                self.arm = towards(&self.arm, &target, share.min(most));
            }
            self.tool_speed = distance(before.position, self.arm.position) / self.step;
            self.time += self.step;
            assert!(self.time < 600.0, "the program does not end");
            let vacuum = self.outputs.iter().filter(|((_, number), on)| *number < 4 && **on);
            self.moments.push(Moment {
                time: self.time,
                arm: self.arm,
                register: self.register,
                vacuum: vacuum.count(),
            });
        }
    }

    fn execute(&mut self, statement: &Statement, locals: &mut BTreeMap<String, Value>) -> Ended {
        match statement {
            Statement::Set { name, local, value } => {
                let value = self.value(value, locals);
                if *local || locals.contains_key(name) {
                    locals.insert(name.clone(), value);
                } else {
                    self.globals.insert(name.clone(), value);
                }
            }
            Statement::Do(call) => {
                self.value(call, locals);
            }
            Statement::If(condition, then, other) => {
                let body = if self.value(condition, locals).bool() { then } else { other };
                return self.block(body, locals);
            }
            Statement::While(condition, body) => {
                while !self.halted && self.value(condition, locals).bool() {
                    match self.block(body, locals) {
                        Ended::On => {}
                        ended => return ended,
                    }
                }
            }
            Statement::Return(value) => return Ended::With(self.value(value, locals)),
            Statement::Define(name, function) => {
                self.functions.insert(name.clone(), function.clone());
            }
            Statement::Halt => self.halted = true,
        }
        if self.halted { Ended::Halted } else { Ended::On }
    }

    fn block(&mut self, body: &[Statement], locals: &mut BTreeMap<String, Value>) -> Ended {
        for statement in body {
            match self.execute(statement, locals) {
                Ended::On => {}
                ended => return ended,
            }
        }
        Ended::On
    }

    fn call(&mut self, name: &str, arguments: Vec<Value>) -> Value {
        let function = self.functions[name].clone();
        assert_eq!(function.parameters.len(), arguments.len(), "{name}");
        let mut locals = function.parameters.iter().cloned().zip(arguments).collect();
        match self.block(&function.body, &mut locals) {
            Ended::With(value) => value,
            _ => Value::Nothing,
        }
    }

    fn value(&mut self, expression: &Expression, locals: &mut BTreeMap<String, Value>) -> Value {
        match expression {
            Expression::Constant(value) => value.clone(),
            Expression::Name(name) => {
                let found = locals.get(name).or_else(|| self.globals.get(name));
                found.unwrap_or_else(|| panic!("{name} has no value")).clone()
            }
            Expression::Index(name, n) => {
                let list = self.value(&Expression::Name(name.clone()), locals);
                Value::Number(match list {
                    Value::List(list) => list[*n],
                    Value::Pose(pose) => {
                        let [x, y, z] = pose.position;
                        let [a, b, c] = turn_from(&Pose::ORIGIN, &pose);
                        [x, y, z, a, b, c][*n]
                    }
                    other => panic!("{other:?} has no items"),
                })
            }
            Expression::List(items) => {
                Value::List(items.iter().map(|item| self.value(item, locals).number()).collect())
            }
            Expression::Not(value) => Value::Bool(!self.value(value, locals).bool()),
            Expression::Pair(left, sign, right) => {
                let left = self.value(left, locals);
                if *sign == "and" {
                    return Value::Bool(left.bool() && self.value(right, locals).bool());
                }
                let (a, b) = (left.number(), self.value(right, locals).number());
                match *sign {
                    "+" => Value::Number(a + b),
                    "-" => Value::Number(a - b),
                    "*" => Value::Number(a * b),
                    "/" => Value::Number(a / b),
                    "<" => Value::Bool(a < b),
                    ">" => Value::Bool(a > b),
                    other => panic!("{other}"),
                }
            }
            Expression::Call(name, arguments) => {
                let given: Vec<Value> =
                    arguments.iter().map(|one| self.value(one, locals)).collect();
                self.built_in(name, given)
            }
        }
    }

    fn built_in(&mut self, name: &str, given: Vec<Value>) -> Value {
        if let Some(kind) = name.strip_prefix("set_").and_then(|n| n.strip_suffix("_digital_out")) {
            let key = (kind.to_owned(), given[0].number() as usize);
            self.outputs.insert(key, given[1].bool());
            return Value::Nothing;
        }
        match name {
            "set_tcp" | "set_target_payload" => {}
            "stopj" => self.advance(None, self.step),
            "popup" => self.said += 1,
            "get_steptime" => return Value::Number(self.step),
            "get_standard_digital_in" => return Value::Bool(true),
            "get_inverse_kin" => return given[0].clone(),
            "get_actual_tcp_pose" => return Value::Pose(self.arm),
            "get_actual_tcp_speed" => {
                return Value::List(vec![self.tool_speed, 0.0, 0.0, 0.0, 0.0, 0.0]);
            }
            "pose_trans" => return Value::Pose(product(&given[0].pose(), &given[1].pose())),
            "pose_inv" => return Value::Pose(inverse(&given[0].pose())),
            "interpolate_pose" => {
                let [from, to] = [0, 1].map(|n| given[n].pose());
                return Value::Pose(towards(&from, &to, given[2].number()));
            }
            "sqrt" => return Value::Number(given[0].number().sqrt()),
            "pow" => return Value::Number(given[0].number().powf(given[1].number())),
            "norm" => match &given[0] {
                Value::List(list) => {
                    return Value::Number(list.iter().map(|x| x * x).sum::<f64>().sqrt());
                }
                other => panic!("{other:?}"),
            },
            "write_output_float_register" => {
                assert_eq!(given[0].number(), 0.0);
                self.register = given[1].number();
            }
            "servoj" => self.advance(Some(given[0].pose()), given[1].number()),
            "sync" => self.advance(None, self.step),
            "sleep" => self.advance(None, given[0].number()),
            // the way to the start
            "movel" => {
                self.arm = given[0].pose();
                self.advance(None, self.step);
            }
            other => return self.call(other, given),
        }
        Value::Nothing
    }
}

/// The statement that begins with the last of some lines.
fn statement(rest: &mut Vec<Line>) -> Statement {
    let mut reader = Reader::of_line(rest.pop().unwrap());
    for (word, local) in [("local", true), ("global", false)] {
        if reader.takes(word) {
            let name = reader.word();
            reader.expect(&["="]);
            let value = expression(&mut reader);
            reader.end();
            return Statement::Set { name, local, value };
        }
    }
    if reader.takes("def") {
        let name = reader.word();
        reader.expect(&["("]);
        let mut parameters = Vec::new();
        while !reader.takes(")") {
            parameters.push(reader.word());
            reader.takes(",");
        }
        reader.expect(&[":"]);
        let (body, _) = body(rest);
        return Statement::Define(name, Rc::new(Function { parameters, body }));
    }
    if reader.takes("while") {
        let condition = expression(&mut reader);
        reader.expect(&[":"]);
        return Statement::While(condition, body(rest).0);
    }
    if reader.takes("if") {
        let condition = expression(&mut reader);
        reader.expect(&[":"]);
        let (then, is_else) = body(rest);
        let other = if is_else { body(rest).0 } else { Vec::new() };
        return Statement::If(condition, then, other);
    }
    if reader.takes("halt") {
        return Statement::Halt;
    }
    if reader.takes("return") {
        return Statement::Return(expression(&mut reader));
    }
    let mark = reader.mark();
    let name = reader.word();
    if reader.takes("=") {
        let value = expression(&mut reader);
        reader.end();
        return Statement::Set { name, local: false, value };
    }
    reader.back(mark);
    let call = expression(&mut reader);
    reader.end();
    Statement::Do(call)
}

/// Statements to the `end` of their block, or to its `else`.
fn body(rest: &mut Vec<Line>) -> (Vec<Statement>, bool) {
    let mut body = Vec::new();
    loop {
        let mut reader = Reader::new(vec![rest.pop().unwrap()]);
        if reader.takes("end") {
            return (body, false);
        }
        if reader.takes("else") {
            return (body, true);
        }
        rest.push(reader.into_line());
        body.push(statement(rest));
    }
}

const LEVELS: [&[&str]; 4] = [&["and"], &["<", ">"], &["+", "-"], &["*", "/"]];

fn expression(reader: &mut Reader) -> Expression {
    level(reader, 0)
}

fn level(reader: &mut Reader, n: usize) -> Expression {
    let Some(signs) = LEVELS.get(n) else { return atom(reader) };
    let mut left = level(reader, n + 1);
    while let Some(sign) = signs.iter().find(|sign| reader.takes(sign)) {
        let right = level(reader, n + 1);
        left = Expression::Pair(Box::new(left), sign, Box::new(right));
    }
    left
}

fn atom(reader: &mut Reader) -> Expression {
    if reader.takes("(") {
        let inner = expression(reader);
        reader.expect(&[")"]);
        return inner;
    }
    if reader.takes("not") {
        return Expression::Not(Box::new(atom(reader)));
    }
    if reader.takes("[") {
        return Expression::List(items(reader, "]"));
    }
    match reader.next() {
        Token::Number(number) => Expression::Constant(Value::Number(number)),
        Token::Text(_) => Expression::Constant(Value::Text),
        Token::Word(word) if word == "True" => Expression::Constant(Value::Bool(true)),
        Token::Word(word) if word == "False" => Expression::Constant(Value::Bool(false)),
        Token::Word(word) if word == "p" => {
            let [x, y, z, a, b, c] = reader.list::<6>();
            assert!(norm([a, b, c]) < std::f64::consts::PI + 1e-6);
            let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let axes = unit.map(|e| turned([a, b, c], e));
            Expression::Constant(Value::Pose(Pose { position: [x, y, z], axes }))
        }
        Token::Word(word) if reader.takes("(") => Expression::Call(word, items(reader, ")")),
        Token::Word(word) if reader.takes("[") => {
            let n = reader.number() as usize;
            reader.expect(&["]"]);
            Expression::Index(word, n)
        }
        Token::Word(word) => Expression::Name(word),
        other => panic!("{other:?}"),
    }
}

/// Items with commas between, some with a name and `=` before, which is for people.
fn items(reader: &mut Reader, close: &str) -> Vec<Expression> {
    let mut items = Vec::new();
    while !reader.takes(close) {
        let mark = reader.mark();
        let is_named = matches!(reader.next(), Token::Word(_)) && reader.takes("=");
        if !is_named {
            reader.back(mark);
        }
        items.push(expression(reader));
        reader.takes(",");
    }
    items
}
