//! Words, numbers and signs of a text, with its lines.

/// One of them.
#[derive(Debug, Clone, PartialEq)]
pub enum Token {
    Word(String),
    Number(f64),
    Text(String),
    Sign(&'static str),
    End,
}

/// Content of one line.
#[derive(Debug)]
pub struct Line {
    pub number: usize,
    pub tokens: Vec<Token>,
}

const SIGNS: [&str; 23] = [
    ":=", "==", "<=", ">", ".", "#", "[", "]", "{", "}", "(", ")", ",", ";", "\\", ":", "=", "$",
    "<", "+", "/", "*", "-",
];

/// The lines of a text of printable ASCII, without comments and empty lines.
pub fn lines(text: &str, comment: &str, longest: usize) -> Vec<Line> {
    assert!(text.ends_with('\n'));
    let mut lines = Vec::new();
    for (n, line) in text.lines().enumerate() {
        assert!(line.bytes().all(|byte| (b' '..=b'~').contains(&byte)), "line {}: {line}", n + 1);
        assert!(line.len() <= longest && line.trim_end() == line, "line {}: {line}", n + 1);
        let code = line.split_once(comment).map_or(line, |(code, _)| code);
        let tokens = tokens(code, n + 1);
        if !tokens.is_empty() {
            lines.push(Line { number: n + 1, tokens });
        }
    }
    lines
}

fn tokens(mut code: &str, number: usize) -> Vec<Token> {
    let mut found: Vec<Token> = Vec::new();
    loop {
        code = code.trim_start();
        let Some(first) = code.chars().next() else { return found };
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        if first.is_ascii_alphabetic() {
            let end = code.find(|c| !is_word(c)).unwrap_or(code.len());
            found.push(Token::Word(code[..end].into()));
            code = &code[end..];
            continue;
        }
        // a sign belongs to a number where no value precedes it
        let after_value =
            matches!(found.last(), Some(Token::Number(_) | Token::Sign(")" | "]" | "}")));
        let digits = code.strip_prefix('-').filter(|_| !after_value).unwrap_or(code);
        if digits.starts_with(|c: char| c.is_ascii_digit()) {
            let lead = code.len() - digits.len();
            let mut end =
                digits.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(digits.len());
            if let Some(rest) = digits[end..].strip_prefix('E') {
                end += 1 + rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
            }
            let text = &code[..lead + end];
            found.push(Token::Number(
                text.parse().unwrap_or_else(|_| panic!("line {number}: {text}")),
            ));
            code = &code[lead + end..];
            continue;
        }
        if let Some(rest) = code.strip_prefix('"') {
            let end = rest.find('"').unwrap_or_else(|| panic!("line {number}"));
            found.push(Token::Text(rest[..end].into()));
            code = &rest[end + 1..];
            continue;
        }
        let sign = SIGNS.iter().find(|sign| code.starts_with(**sign));
        let sign = sign.unwrap_or_else(|| panic!("line {number}: {code}"));
        found.push(Token::Sign(sign));
        code = &code[sign.len()..];
    }
}

/// Reads tokens one after the other.
#[derive(Debug)]
pub struct Reader {
    tokens: Vec<(Token, usize)>,
    at: usize,
}

impl Reader {
    pub fn new(lines: Vec<Line>) -> Self {
        let all = lines.into_iter();
        let tokens = all.flat_map(|l| l.tokens.into_iter().map(move |token| (token, l.number)));
        Reader { tokens: tokens.collect(), at: 0 }
    }

    pub fn of_line(line: Line) -> Self {
        Reader::new(vec![line])
    }

    /// Where it is, for [`Self::back`].
    pub fn mark(&self) -> usize {
        self.at
    }

    pub fn back(&mut self, mark: usize) {
        self.at = mark;
    }

    /// The line that it was made of.
    pub fn into_line(self) -> Line {
        let number = self.tokens.first().map_or(0, |(_, number)| *number);
        Line { number, tokens: self.tokens.into_iter().map(|(token, _)| token).collect() }
    }

    pub fn peek(&self) -> &Token {
        self.tokens.get(self.at).map_or(&Token::End, |(token, _)| token)
    }

    pub fn next(&mut self) -> Token {
        let token = self.peek().clone();
        self.at += 1;
        token
    }

    pub fn fault(&self, wanted: &str) -> ! {
        let line = self.tokens.get(self.at.min(self.tokens.len() - 1)).map(|(_, line)| line);
        panic!("line {line:?}: expected {wanted}, not {:?}", self.peek())
    }

    /// Whether a sign or a word comes next; if so, it is read.
    pub fn takes(&mut self, wanted: &str) -> bool {
        let found = match self.peek() {
            Token::Sign(sign) => *sign == wanted,
            Token::Word(word) => word == wanted,
            _ => false,
        };
        self.at += usize::from(found);
        found
    }

    /// Which of two words comes next: whether it is the first one.
    pub fn switch(&mut self, on: &str, off: &str) -> bool {
        let is_on = self.takes(on);
        if !is_on {
            self.expect(&[off]);
        }
        is_on
    }

    pub fn expect(&mut self, wanted: &[&str]) {
        for wanted in wanted {
            if !self.takes(wanted) {
                self.fault(wanted);
            }
        }
    }

    pub fn word(&mut self) -> String {
        match self.next() {
            Token::Word(word) => word,
            _ => {
                self.at -= 1;
                self.fault("a name")
            }
        }
    }

    pub fn number(&mut self) -> f64 {
        match self.next() {
            Token::Number(number) => number,
            _ => {
                self.at -= 1;
                self.fault("a number")
            }
        }
    }

    /// Numbers with commas between them.
    pub fn numbers<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|n| {
            if n > 0 {
                self.expect(&[","]);
            }
            self.number()
        })
    }

    /// Numbers in square brackets.
    pub fn list<const N: usize>(&mut self) -> [f64; N] {
        self.expect(&["["]);
        let numbers = self.numbers();
        self.expect(&["]"]);
        numbers
    }

    pub fn end(&mut self) {
        if *self.peek() != Token::End {
            self.fault("the end");
        }
    }
}
