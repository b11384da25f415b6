//! What hangs where: the spans of a ply at given gripper positions, and what holds their ends.
//!
//! The slope rules of the paper (section 2.2), eqs. (6)–(8) of `docs/theory/ply.md`. Everything that
//! depends on a position is a [`Number`], so the same code gives the assembly and its derivative.

use super::Number;
use super::slopes::contact_end;
use crate::catenary::SpanState;
use crate::ply::{Catenary, Grid, Kind, Laid, Ply, shear};
use crate::scene::Settings;

/// One free span of the ply.
#[derive(Debug, Clone, Copy)]
pub struct Element<T> {
    /// Index of its catenary, see [`Grid::catenary`].
    pub catenary: usize,
    /// 0 for a whole catenary or the rest before the contact segment, 1 for the rest after it.
    pub rest: usize,
    /// Horizontal distance of its ends ℓ (m).
    pub run: T,
    /// Height of its second end above its first h (m).
    pub rise: T,
    /// Fabric length L_set (m).
    pub length: T,
    /// Weight per length (N/m).
    pub weight: T,
    /// Flexural rigidity EI (N·m²).
    pub rigidity: T,
    /// What holds its ends.
    pub ends: [End<T>; 2],
    /// How it holds its length.
    pub state: SpanState,
}

/// What holds an end of an element.
#[derive(Debug, Clone, Copy)]
pub enum End<T> {
    /// No moment.
    Free,
    /// A given slope: constrained by a shearing cell, or the mold's.
    Given(T),
    /// The shared slope of a joint.
    Joint(usize),
    /// A diagonal: the plane through two edge slopes.
    Plane(PlaneSlope<T>),
}

/// Slope of the plane through the two edge slopes of a cell at a gripper, along a diagonal.
#[derive(Debug, Clone, Copy)]
pub struct PlaneSlope<T> {
    /// Share of the edge slope along u and along v.
    pub share: [T; 2],
    /// Those edge slopes.
    pub source: [SlopeSource<T>; 2],
}

/// Where an edge slope at a gripper comes from.
#[derive(Debug, Clone, Copy)]
pub enum SlopeSource<T> {
    /// Known beforehand.
    Given(T),
    /// The shared slope of a joint.
    Joint(usize),
    /// The free end of an element: (element, end).
    Outcome(usize, usize),
}

/// A gripper through which a line of edges passes with one unknown slope.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Joint {
    /// Index of the gripper.
    pub gripper: usize,
    /// 0 along u, 1 along v.
    pub direction: usize,
    /// The elements that end and begin here.
    pub elements: [usize; 2],
}

/// An edge of the ply on one side of a gripper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Side<T> {
    /// The ply ends here.
    None,
    /// It hangs: this element, by this end.
    Hanging(usize, usize),
    /// It is straight or lies on the mold, at this slope.
    Fixed(T),
}

/// A ply at given gripper positions.
#[derive(Debug, Clone)]
pub struct Assembly<T> {
    /// All free spans: those of edges first, then those of diagonals.
    pub elements: Vec<Element<T>>,
    /// Number of edge elements.
    pub edge_elements: usize,
    /// Unknown shared slopes, line by line: u-lines first, each in ascending order.
    pub joints: Vec<Joint>,
    /// Taut path of the stretched diagonal of each cell (m) and whether it is the falling one.
    pub shearing: Vec<Option<(T, bool)>>,
    /// The plane that shearing cells prescribe at each gripper, where they do.
    pub constraints: Vec<Option<Constraint<T>>>,
    /// The edges around each gripper: `[direction][before, after]`.
    pub sides: Vec<[[Side<T>; 2]; 2]>,
    /// Whether lines along u and along v have a bending stiffness.
    pub is_rigid: [bool; 2],
    pub(super) joint_at: Vec<[Option<usize>; 2]>,
    pub(super) directions: Vec<[[T; 2]; 2]>,
}

/// What the shearing cells around a gripper prescribe there: a plane, and how much it counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint<T> {
    /// Unit normal of the plane, upwards.
    pub normal: [T; 3],
    /// Weight w of the plane, from 0 at the onset of shear to 1: the slope is `(1−w) s_free + w s_plane`.
    pub weight: T,
}

impl<T: Number> Constraint<T> {
    /// Slope of the plane along a horizontal unit vector: −(n·e)/n_z.
    #[must_use]
    pub fn slope(&self, heading: [T; 2]) -> T {
        let ([nx, ny, nz], zero) = (self.normal, T::from(0.0));
        // a level plane has the slope 0, not −0
        zero - (nx * heading[0] + ny * heading[1]) / nz
    }

    /// The constrained slope along a horizontal unit vector, `free` the slope without the constraint.
    #[must_use]
    pub fn blend(&self, free: Option<T>, heading: [T; 2]) -> T {
        let plane = self.slope(heading);
        match free {
            Some(free) if self.is_partial() => free + self.weight * (plane - free),
            _ => plane,
        }
    }

    /// Whether the unconstrained slope still counts.
    #[must_use]
    pub fn is_partial(&self) -> bool {
        self.weight.re() < 1.0
    }
}

/// Horizontal parts of a straight line.
#[derive(Clone, Copy)]
pub(super) struct Line<T> {
    delta: [T; 2],
    run: T,
    rise: T,
    chord: T,
}

/// Runs below this share of the length are vertical lines: no horizontal force, no catenary.
const VERTICAL: f64 = 1e-3;

fn constant<T: Number>(p: [f64; 3]) -> [T; 3] {
    p.map(T::from)
}

/// √(x²), which at 0 has the derivative 0.
fn root<T: Number>(square: T) -> T {
    if square.re() > 0.0 { square.sqrt() } else { T::from(0.0) }
}

fn line<T: Number>(from: [T; 3], to: [T; 3]) -> Line<T> {
    let delta = [to[0] - from[0], to[1] - from[1]];
    let rise = to[2] - from[2];
    let square = delta[0] * delta[0] + delta[1] * delta[1];
    Line { delta, run: root(square), rise, chord: root(square + rise * rise) }
}

impl<T: Number> Line<T> {
    fn is_vertical(&self, length: f64) -> bool {
        self.run.re() <= VERTICAL * length.max(self.chord.re())
    }

    /// Slope from the first end to the second; 0 if they coincide.
    pub(super) fn slope(&self) -> T {
        if self.run.re() > 0.0 { self.rise / self.run } else { T::from(0.0) }
    }

    /// From the first end to the second.
    pub(super) fn vector(&self) -> [T; 3] {
        [self.delta[0], self.delta[1], self.rise]
    }

    pub(super) fn unit(&self) -> [T; 2] {
        if self.run.re() > 0.0 { self.delta.map(|d| d / self.run) } else { [T::from(0.0); 2] }
    }
}

/// The catenaries around a cell and the contact on them, for building an [`Assembly`].
pub struct Build<'a, T> {
    /// The ply.
    pub ply: &'a Ply,
    /// Rules of the model.
    pub settings: &'a Settings,
    /// Positions of the grippers (m).
    pub positions: &'a [[T; 3]],
    /// What the mold has caught of each catenary.
    pub laid: &'a [Option<Laid>],
    /// What multiplies the ply's numbers: 1, but for their derivatives.
    pub factors: Factors<T>,
    /// Shear angle from which a cell's plane prescribes its slopes alone (rad).
    pub full_constraint: f64,
    /// Slopes at both ends of every element in the equilibrium without constraints, where it is known.
    pub free: &'a [[T; 2]],
    /// Whether shearing cells constrain slopes.
    pub constrained: bool,
}

/// Factors on what a ply is, each for lines along u, lines along v and diagonals.
#[derive(Debug, Clone, Copy)]
pub struct Factors<T> {
    /// On fabric lengths.
    pub length: [T; 3],
    /// On the weight.
    pub weight: [T; 3],
    /// On the flexural rigidity.
    pub rigidity: [T; 3],
}

/// The grippers before and behind one along a direction (0: u, 1: v); itself on the boundary.
#[must_use]
pub fn neighbours(grid: Grid, gripper: usize, direction: usize) -> [usize; 2] {
    let [i, j] = grid.id(gripper);
    let (index, count) = if direction == 0 { (i, grid.nu) } else { (j, grid.nv) };
    let at = |k: usize| grid.index(if direction == 0 { [k, j] } else { [i, k] });
    [at(index.saturating_sub(1)), at((index + 1).min(count - 1))]
}

/// Horizontal unit vector of the line through a gripper along a direction (0: u, 1: v): from the gripper
/// before it to the one behind it.
pub fn heading<T: Number>(
    grid: Grid,
    positions: &[[T; 3]],
    gripper: usize,
    direction: usize,
) -> Option<[T; 2]> {
    let [before, after] = neighbours(grid, gripper, direction);
    let way = line(positions[before], positions[after]);
    (way.run.re() > 0.0).then(|| way.unit())
}

/// Which of three [`Factors`] is a catenary's.
pub(super) fn class(kind: Kind) -> usize {
    match kind {
        Kind::EdgeU => 0,
        Kind::EdgeV => 1,
        Kind::Rising | Kind::Falling => 2,
    }
}

impl<T: Number> Build<'_, T> {
    pub(super) fn grid(&self) -> Grid {
        self.ply.grid
    }

    fn ends(&self, c: &Catenary) -> [[T; 3]; 2] {
        [c.from, c.to].map(|g| self.positions[self.grid().index(g)])
    }

    /// From the first gripper of a catenary to its second (m).
    pub(super) fn chord(&self, catenary: usize) -> [T; 3] {
        let [from, to] = self.ends(&self.grid().catenary(catenary));
        [0, 1, 2].map(|n| to[n] - from[n])
    }

    /// Whether the lines of edges along a direction have bending stiffness.
    pub(super) fn is_rigid(&self, direction: usize) -> bool {
        let kind = if direction == 0 { Kind::EdgeU } else { Kind::EdgeV };
        self.ply.line(kind).flexural_rigidity > 0.0
    }

    /// The rest that holds on to an end of a catenary: the line from its first to its second end.
    pub(super) fn rest_line(&self, catenary: usize, end: usize) -> Line<T> {
        let ends = self.ends(&self.grid().catenary(catenary));
        match &self.laid[catenary] {
            None => line(ends[0], ends[1]),
            // nor has one that lies a direction of its own: it goes on as the segment ends
            Some(laid)
                if (laid.rest(end) <= 0.0 || laid.lying[end]) && laid.line.length() > 0.0 =>
            {
                let [a, b] = laid.end_piece(end).map(constant);
                line(a, b)
            }
            Some(laid) => {
                // a touch at the very gripper has no direction: the other rest leaves from there
                let point = laid.line.length() <= 0.0 && laid.rest(end) <= 0.0;
                if (end == 0) != point {
                    line(ends[0], constant(laid.point()[0]))
                } else {
                    line(constant(laid.point()[1]), ends[1])
                }
            }
        }
    }

    /// Taut path from end to end: straight, and along the mold where the ply lies.
    fn taut_path(&self, catenary: usize) -> T {
        let ends = self.ends(&self.grid().catenary(catenary));
        match &self.laid[catenary] {
            None => line(ends[0], ends[1]).chord,
            Some(laid) => {
                let [a, b] = laid.point().map(constant);
                let along = laid.line.length() + laid.arch[0] + laid.arch[1];
                let factor = self.factors.length[class(self.grid().catenary(catenary).kind)];
                line(ends[0], a).chord + line(b, ends[1]).chord + factor * along
            }
        }
    }
}

impl<T> Default for Assembly<T> {
    fn default() -> Self {
        Assembly {
            elements: Vec::new(),
            edge_elements: 0,
            joints: Vec::new(),
            shearing: Vec::new(),
            constraints: Vec::new(),
            sides: Vec::new(),
            is_rigid: [true; 2],
            joint_at: Vec::new(),
            directions: Vec::new(),
        }
    }
}

impl<T: Number> Assembly<T> {
    /// Rebuilds the assembly in place.
    pub fn rebuild(&mut self, build: &Build<T>) {
        let grid = build.grid();
        self.elements.clear();
        self.joints.clear();
        self.is_rigid = [0, 1].map(|direction| build.is_rigid(direction));
        self.shear(build);
        self.constrain(build);
        self.sides.clear();
        self.sides.resize(grid.grippers(), [[Side::None; 2]; 2]);
        self.joint_at.clear();
        self.joint_at.resize(grid.grippers(), [None; 2]);
        self.directions.clear();
        for catenary in 0..grid.edges() {
            self.edge(build, catenary);
        }
        self.edge_elements = self.elements.len();
        self.join(build);
        for catenary in grid.edges()..grid.catenaries() {
            self.diagonal(build, catenary);
        }
        if !build.constrained {
            self.stretched_diagonals(build);
        }
    }

    /// The stretched diagonals as spans of the flat cell's length, behind all other elements.
    ///
    /// Just before the onset of shear a taut diagonal draws all slopes by its large force. Without constraints it
    /// does so still, so that these slopes do not jump at the onset.
    fn stretched_diagonals(&mut self, build: &Build<T>) {
        let first = build.grid().edges();
        for cell in 0..build.grid().cells() {
            if let Some((_, falling)) = self.shearing[cell] {
                let catenary = first + 2 * cell + usize::from(falling);
                let kind = build.grid().catenary(catenary).kind;
                let flat = T::from(build.ply.flat_length(kind)) * build.factors.length[2];
                self.hang_diagonal(build, catenary, flat);
            }
        }
    }

    /// Which diagonal of each cell is stretched.
    fn shear(&mut self, build: &Build<T>) {
        let grid = build.grid();
        self.shearing.clear();
        for cell in 0..grid.cells() {
            let [rising, falling] = [0, 1].map(|n| build.taut_path(grid.edges() + 2 * cell + n));
            let longer = if falling.re() > rising.re() { (falling, true) } else { (rising, false) };
            let shears = shear::is_shearing(build.ply.sides(cell, build.laid), longer.0.re());
            self.shearing.push(shears.then_some(longer));
        }
    }

    fn element(
        &self,
        build: &Build<T>,
        catenary: usize,
        rest: usize,
        line: &Line<T>,
        length: T,
    ) -> Element<T> {
        let kind = build.grid().catenary(catenary).kind;
        let (section, class) = (build.ply.line(kind), class(kind));
        let mut element = Element {
            catenary,
            rest,
            run: line.run,
            rise: line.rise,
            length,
            weight: build.factors.weight[class] * (section.mass * build.settings.gravity),
            rigidity: build.factors.rigidity[class] * section.flexural_rigidity,
            ends: [End::Free; 2],
            state: SpanState::Straight,
        };
        if !line.is_vertical(length.re()) {
            element.state = element.span(build.settings.axial_stiffness, &[]).state();
        }
        element
    }

    /// The elements of an edge, and what its grippers see of it.
    fn edge(&mut self, build: &Build<T>, catenary: usize) {
        let grid = build.grid();
        let c = grid.catenary(catenary);
        let direction = usize::from(c.kind == Kind::EdgeV);
        let factor = build.factors.length[direction];
        let flat = T::from(build.ply.flat_length(c.kind)) * factor;
        let mut directions = [[T::from(0.0); 2]; 2];
        let mut whole = None;
        for end in 0..2 {
            let line = build.rest_line(catenary, end);
            directions[end] = line.unit();
            let gripper = grid.index(if end == 0 { c.from } else { c.to });
            let side = 1 - end;
            let (hangs, length) = match &build.laid[catenary] {
                None => (true, flat),
                Some(laid) => {
                    let place = build.ends(&c)[end].map(|x| x.re());
                    let hangs = laid.hangs(end) && !laid.is_folded(end, place);
                    (hangs, T::from(laid.rest(end)) * factor)
                }
            };
            let mut seen = Side::Fixed(line.slope());
            if hangs {
                let index = match whole {
                    Some(index) => index,
                    None => {
                        let mut element = self.element(build, catenary, end, &line, length);
                        if let Some(laid) = &build.laid[catenary] {
                            element.ends[1 - end] = contact_end(build, c.kind, laid, end, &line);
                        } else {
                            element.rest = 0;
                        }
                        self.elements.push(element);
                        self.elements.len() - 1
                    }
                };
                if build.laid[catenary].is_none() {
                    whole = Some(index);
                }
                if self.elements[index].state != SpanState::Straight {
                    seen = Side::Hanging(index, end);
                }
            }
            self.sides[gripper][direction][side] = seen;
        }
        self.directions.push(directions);
    }

    /// The elements of a diagonal, unless it is stretched straight.
    fn diagonal(&mut self, build: &Build<T>, catenary: usize) {
        let grid = build.grid();
        let cell = (catenary - grid.edges()) / 2;
        let c = grid.catenary(catenary);
        let falling = c.kind == Kind::Falling;
        let stretched = self.shearing[cell];
        // once it has landed, its free segments are spans like any other
        let landed = build.laid[catenary].is_some();
        if stretched.is_some_and(|(_, which)| which == falling) && !landed {
            return;
        }
        let [along_u, along_v, factor] = build.factors.length;
        let flat = T::from(build.ply.flat_length(c.kind)) * factor;
        let length = match stretched {
            Some((path, _)) => {
                let [a, b] = build.ply.sides(cell, build.laid);
                shear::partner_length([along_u * a, along_v * b], path)
            }
            None => flat,
        };
        self.hang_diagonal(build, catenary, length);
    }

    /// The elements of a diagonal of a given fabric length (m).
    fn hang_diagonal(&mut self, build: &Build<T>, catenary: usize, length: T) {
        let grid = build.grid();
        let (cell, c) = ((catenary - grid.edges()) / 2, grid.catenary(catenary));
        let factor = build.factors.length[2];
        for rest in 0..2 {
            let line = build.rest_line(catenary, rest);
            let element = self.elements.len();
            let ends = [0, 1].map(|end| self.plane(build, cell, c, [end, element], &line));
            match &build.laid[catenary] {
                None => {
                    let mut element = self.element(build, catenary, 0, &line, length);
                    element.ends = ends;
                    self.elements.push(element);
                    return;
                }
                Some(laid)
                    if laid.hangs(rest)
                        && !laid.is_folded(rest, build.ends(&c)[rest].map(|x| x.re())) =>
                {
                    let length = T::from(laid.rest(rest)) * factor;
                    let mut element = self.element(build, catenary, rest, &line, length);
                    element.ends[rest] = ends[rest];
                    element.ends[1 - rest] = contact_end(build, c.kind, laid, rest, &line);
                    self.elements.push(element);
                }
                Some(_) => {}
            }
        }
    }

    /// Slope of the ply at a gripper along a direction (0: u, 1: v), `heading` in plan; none where the ply has no
    /// edge in that direction.
    ///
    /// That of the plane of the shearing cells, or the shared one; on the boundary that of the one edge; where two
    /// edges keep slopes of their own (a limp ply, or one side in contact) their mean.
    pub fn gripper_slope(
        &self,
        gripper: usize,
        direction: usize,
        heading: [T; 2],
        [free, held]: [&[[T; 2]]; 2],
    ) -> Option<T> {
        let mean = |ends: &[[T; 2]]| {
            let (mut sum, mut count) = (T::from(0.0), 0.0);
            for side in self.sides[gripper][direction] {
                sum += match side {
                    Side::None => continue,
                    Side::Hanging(element, end) => ends[element][end],
                    Side::Fixed(slope) => slope,
                };
                count += 1.0;
            }
            (count > 0.0).then(|| sum / count)
        };
        match self.constraints[gripper].filter(|_| self.is_rigid[direction]) {
            Some(constraint) if constraint.is_partial() => {
                Some(constraint.blend(mean(free), heading))
            }
            Some(constraint) => Some(constraint.slope(heading)),
            None => mean(held),
        }
    }

    /// Whether a gripper's slopes are still mixed with those of the unconstrained ply.
    #[must_use]
    pub fn is_partly_constrained(&self) -> bool {
        self.constraints.iter().flatten().any(Constraint::is_partial)
    }

    /// The unknown joint of a gripper along a direction, if it has one.
    #[must_use]
    pub fn joint(&self, gripper: usize, direction: usize) -> Option<usize> {
        self.joint_at[gripper][direction]
    }
}
