//! What hangs where: the free spans of a ply at given gripper positions, and what holds their ends.
//!
//! The slope rules of the paper (section 2.2), eqs. (6)–(8) of `docs/theory/ply.md`. [`Circumstances`] say what is asked
//! for, `constraint` which slopes shearing cells prescribe, and `slopes` which ones are unknown.

mod circumstances;
mod constraint;
mod element;
mod line;
mod slopes;

pub use circumstances::{Circumstances, Factors};
pub use constraint::{Constraint, Stretched};
pub use element::{Element, End, PlaneSlope, SlopeSource};
pub use line::heading;
pub use slopes::{SharedSlope, Side};

use super::Number;
use crate::catenary::SpanState;
use crate::ply::{BiasLines, Fibers, Kind, shear};
use slopes::Slopes;

/// The free spans of a ply at given gripper positions. A solve does not change it.
#[derive(Debug, Clone)]
pub struct Problem<T> {
    /// All free spans: those of edges first, then those of diagonals.
    pub elements: Vec<Element<T>>,
    /// Number of edge elements.
    pub edge_elements: usize,
    /// The stretched bias lines of each cell.
    pub shearing: Vec<Stretched<T>>,
    /// Taut path of each bias line that is stretched.
    stretched: Vec<Option<T>>,
    /// Number of fiber lines.
    edges: usize,
    /// The plane that shearing cells prescribe at each gripper, where they do.
    pub constraints: Vec<Option<Constraint<T>>>,
    slopes: Slopes<T>,
    is_rigid: [bool; 2],
}

impl<T> Default for Problem<T> {
    fn default() -> Self {
        Problem {
            elements: Vec::new(),
            edge_elements: 0,
            shearing: Vec::new(),
            stretched: Vec::new(),
            edges: 0,
            constraints: Vec::new(),
            slopes: Slopes::default(),
            is_rigid: [true; 2],
        }
    }
}

impl<T: Number> Problem<T> {
    /// States the problem anew, in place.
    pub(crate) fn rebuild(&mut self, around: &Circumstances<T>) {
        let lines = around.lines;
        self.edges = lines.edges();
        self.elements.clear();
        self.is_rigid = [0, 1].map(|direction| around.is_rigid(direction));
        self.shear(around);
        constraint::constrain(around, &self.shearing, &mut self.constraints);
        self.slopes.reset(lines.grippers());
        for catenary in 0..lines.edges() {
            self.edge(around, catenary);
        }
        self.edge_elements = self.elements.len();
        self.slopes.hold_edges(around, &self.constraints, &mut self.elements);
        for catenary in lines.edges()..lines.catenaries() {
            self.diagonal(around, catenary);
        }
        if !around.constrained {
            self.stretched_diagonals(around);
        }
    }

    /// Which bias lines of each cell are stretched. The two sides of a cell that run in one direction shear it together, by the
    /// mean of their squares: that holds whatever the sides are, as the fibers are straight and cross in their middles.
    fn shear(&mut self, around: &Circumstances<T>) {
        self.shearing.clear();
        self.stretched.clear();
        self.stretched.resize(around.lines.catenaries() - self.edges, None);
        for cell in around.lines.cells() {
            let path = |bias: &BiasLines| {
                shear::mean_path(bias.list().iter().map(|n| around.taut_path(*n)))
            };
            let [rising, falling] = cell.bias.each_ref().map(path);
            let longer = if falling.re() > rising.re() { (falling, true) } else { (rising, false) };
            let trellis = around.ply.trellis(cell, around.contacts);
            let shears = shear::is_shearing(trellis, longer.0.re());
            self.shearing.push(shears.then_some(longer));
            for (bias, falling) in cell.bias.iter().zip([false, true]) {
                for n in bias.list() {
                    let path = around.taut_path(*n);
                    let is_stretched = match cell.fibers {
                        Fibers::Sides => shears && falling == longer.1,
                        // a side is stretched by its own ends, whichever of its two cells shears more
                        Fibers::Diagonals => shear::is_shearing(trellis, path.re()),
                    };
                    if is_stretched {
                        self.stretched[*n - self.edges] = Some(path);
                    }
                }
            }
        }
    }

    /// Taut path (m) of a bias line that is stretched.
    #[must_use]
    pub fn stretched(&self, catenary: usize) -> Option<T> {
        let bias = catenary.checked_sub(self.edges)?;
        self.stretched[bias]
    }

    /// The elements of an edge, and what its grippers see of it.
    fn edge(&mut self, around: &Circumstances<T>, catenary: usize) {
        let (kind, first) = (around.kind(catenary), self.elements.len());
        let seen = [0, 1].map(|end| {
            let line = around.segment_line(catenary, end);
            match &around.contacts[catenary] {
                // one span from gripper to gripper
                None if end == 0 => {
                    let length = around.flat_length(catenary);
                    self.elements.push(around.element(catenary, 0, &line, length));
                }
                Some(contact) if around.hangs(catenary, contact, end) => {
                    self.elements.push(around.free_segment(catenary, contact, end, &line));
                }
                _ => {}
            }
            let new = self.elements[first..].last();
            let own = new.filter(|e| around.contacts[catenary].is_none() || e.segment == end);
            let side = match own {
                Some(e) if e.state != SpanState::Straight => {
                    Side::Hanging(self.elements.len() - 1, end)
                }
                _ => Side::Fixed(line.slope()),
            };
            (side, line.heading())
        });
        let grippers = around.lines.ends(catenary);
        self.slopes.see(grippers, usize::from(kind == Kind::EdgeV), seen);
    }

    /// The elements of a bias line, unless it is stretched straight.
    fn diagonal(&mut self, around: &Circumstances<T>, catenary: usize) {
        // once it has landed, its free segments are spans like any other
        if self.stretched(catenary).is_none() || around.contacts[catenary].is_some() {
            self.hang_diagonal(around, catenary, self.set_length(around, catenary));
        }
    }

    /// Set length of a bias line (m): that of the flat ply, or what a cell that shears across it leaves it. A side between
    /// two cells has the mean of both by their squares: that is the side at the mean of the sines of their shear angles.
    fn set_length(&self, around: &Circumstances<T>, catenary: usize) -> T {
        let is_falling = around.kind(catenary) == Kind::Falling;
        shear::mean_path(around.lines.cells_of(catenary).map(|cell| match self.shearing[cell] {
            Some((path, falling)) if falling != is_falling => {
                shear::partner_length(around.trellis(cell), path)
            }
            _ => around.flat_length(catenary),
        }))
    }

    /// The stretched bias lines as spans of the flat cell's length, behind all other elements.
    ///
    /// Just before the onset of shear a taut bias line draws all slopes by its large force. Without constraints it
    /// does so still, so that these slopes do not jump at the onset.
    fn stretched_diagonals(&mut self, around: &Circumstances<T>) {
        for catenary in around.lines.edges()..around.lines.catenaries() {
            if self.stretched(catenary).is_some() {
                self.hang_diagonal(around, catenary, around.flat_length(catenary));
            }
        }
    }

    /// The elements of a bias line of a given fabric length (m).
    fn hang_diagonal(&mut self, around: &Circumstances<T>, catenary: usize, length: T) {
        for segment in 0..2 {
            let line = around.segment_line(catenary, segment);
            let number = self.elements.len();
            let held = |end: usize| {
                let place = [number, end];
                self.slopes.diagonal_end(around, &self.constraints, catenary, place, &line)
            };
            match &around.contacts[catenary] {
                None => {
                    let mut element = around.element(catenary, 0, &line, length);
                    element.ends = [held(0), held(1)];
                    self.elements.push(element);
                    return;
                }
                Some(contact) if around.hangs(catenary, contact, segment) => {
                    let mut element = around.free_segment(catenary, contact, segment, &line);
                    element.ends[segment] = held(segment);
                    self.elements.push(element);
                }
                Some(_) => {}
            }
        }
    }

    /// Slope of the ply at a gripper along a direction (0: u, 1: v), `heading` in plan; `None` where the ply has no
    /// edge in that direction. `free` and `held` are the slopes at both ends of an element, without constraints and with.
    ///
    /// That of the plane of the shearing cells, or the shared one; on the boundary that of the one edge; where two
    /// edges keep slopes of their own (a limp ply, or one side in contact) their mean.
    pub fn gripper_slope(
        &self,
        gripper: usize,
        direction: usize,
        heading: [T; 2],
        free: impl Fn(usize) -> Option<[T; 2]>,
        held: impl Fn(usize) -> Option<[T; 2]>,
    ) -> Option<T> {
        let sides = self.slopes.sides()[gripper][direction];
        match self.constraints[gripper].filter(|_| self.is_rigid[direction]) {
            Some(constraint) => Some(constraint.blend(mean(sides, free), heading)),
            None => mean(sides, held),
        }
    }

    /// Whether a gripper's slopes are still mixed with those of the unconstrained ply.
    #[must_use]
    pub fn is_partly_constrained(&self) -> bool {
        self.constraints.iter().flatten().any(Constraint::is_partial)
    }

    /// The unknown slopes, line by line: u-lines first, each in ascending order.
    #[must_use]
    pub fn shared_slopes(&self) -> &[SharedSlope] {
        self.slopes.shared()
    }

    /// The edges around each gripper: `[direction][before, after]`.
    #[must_use]
    pub fn sides(&self) -> &[[[Side<T>; 2]; 2]] {
        self.slopes.sides()
    }
}

/// Mean slope of the edges on both sides of a gripper, `ends` the slopes at both ends of an element.
fn mean<T: Number>(sides: [Side<T>; 2], ends: impl Fn(usize) -> Option<[T; 2]>) -> Option<T> {
    let (mut sum, mut count) = (T::from(0.0), 0.0);
    for side in sides {
        sum += match side {
            Side::None => continue,
            Side::Hanging(element, end) => ends(element)?[end],
            Side::Fixed(slope) => slope,
        };
        count += 1.0;
    }
    (count > 0.0).then(|| sum / count)
}
