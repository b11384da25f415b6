//! The input of an equilibrium: a ply, the positions of its grippers and its contact with the mold.
//!
//! Everything that depends on a position or on the ply's numbers is a [`Number`], so that the same code gives
//! the problem and its derivative along a direction.

use super::element::{Element, End, class};
use super::line::StraightLine;
use crate::catenary::SpanState;
use crate::equilibrium::{EquilibriumTuning, Number};
use crate::layup::{ContactEnd, Settings};
use crate::ply::{ContactSegment, Kind, Lines, Ply};

/// The ply at given gripper positions, from which a [`super::Problem`] is built.
pub struct Circumstances<'a, T> {
    /// The ply.
    pub ply: &'a Ply,
    /// Lines of the ply.
    pub lines: &'a Lines,
    /// Rules of the model.
    pub settings: &'a Settings,
    /// Constants of the method.
    pub tuning: &'a EquilibriumTuning,
    /// Positions of the grippers (m).
    pub positions: &'a [[T; 3]],
    /// Contact segment of each catenary.
    pub contacts: &'a [Option<ContactSegment>],
    /// Factors on the numbers of the ply: 1, with their derivatives.
    pub factors: Factors<T>,
    /// Slopes at both ends of every element in the equilibrium without constraints, where it is known.
    pub free: &'a [[T; 2]],
    /// Whether shearing cells constrain slopes.
    pub constrained: bool,
}

/// Factors on the properties of a ply, each for lines along u, lines along v and diagonals.
#[derive(Debug, Clone, Copy)]
pub struct Factors<T> {
    /// On fabric lengths.
    pub length: [T; 3],
    /// On the weight.
    pub weight: [T; 3],
    /// On the flexural rigidity.
    pub rigidity: [T; 3],
}

fn constant<T: Number>(p: [f64; 3]) -> [T; 3] {
    p.map(T::from)
}

impl<T: Number> Circumstances<'_, T> {
    /// Kind of a catenary.
    pub fn kind(&self, catenary: usize) -> Kind {
        self.lines.catenary(catenary).kind
    }

    fn ends(&self, catenary: usize) -> [[T; 3]; 2] {
        self.lines.ends(catenary).map(|gripper| self.positions[gripper])
    }

    /// From the first gripper of a catenary to its second (m).
    pub fn chord(&self, catenary: usize) -> [T; 3] {
        let [from, to] = self.ends(catenary);
        [0, 1, 2].map(|n| to[n] - from[n])
    }

    /// Sides of the trellis of a cell as its bias lines measure it (m).
    pub fn trellis(&self, cell: usize) -> [T; 2] {
        let [along_u, along_v, _] = self.factors.length;
        let [a, b] = self.ply.trellis(&self.lines.cells()[cell], self.contacts);
        [along_u * a, along_v * b]
    }

    /// Fabric length of a catenary in the flat ply (m).
    pub fn flat_length(&self, catenary: usize) -> T {
        let nominal = self.lines.flat_length(catenary, self.ply.length_factor);
        self.factors.length[class(self.kind(catenary))] * nominal
    }

    /// Whether the lines of edges along a direction have bending stiffness.
    pub fn is_rigid(&self, direction: usize) -> bool {
        let kind = if direction == 0 { Kind::EdgeU } else { Kind::EdgeV };
        self.ply.line(kind).flexural_rigidity > 0.0
    }

    /// Whether the free segment at an end of a catenary in contact hangs: it has not lain down, nor is it a fold.
    pub fn hangs(&self, catenary: usize, contact: &ContactSegment, end: usize) -> bool {
        let place = self.ends(catenary)[end];
        contact.hangs(end) && !contact.is_folded(end, place.map(|x| x.re()))
    }

    /// The straight line of the free segment at an end of a catenary, from its first to its second end.
    pub fn segment_line(&self, catenary: usize, end: usize) -> StraightLine<T> {
        let ends = self.ends(catenary);
        match &self.contacts[catenary] {
            None => StraightLine::new(ends[0], ends[1]),
            // one that lies, or has no length, has no direction of its own: it goes on as the contact segment ends
            Some(contact)
                if (contact.free_length(end) <= 0.0 || contact.lying[end])
                    && contact.line.length() > 0.0 =>
            {
                let [a, b] = contact.end_piece(end).map(constant);
                StraightLine::new(a, b)
            }
            Some(contact) => {
                // a touch at the very gripper has no direction: the other free segment leaves from there
                let point = contact.line.length() <= 0.0 && contact.free_length(end) <= 0.0;
                if (end == 0) != point {
                    StraightLine::new(ends[0], constant(contact.point()[0]))
                } else {
                    StraightLine::new(constant(contact.point()[1]), ends[1])
                }
            }
        }
    }

    /// Taut path from end to end (m): straight, and along the mold where the ply lies.
    pub fn taut_path(&self, catenary: usize) -> T {
        let ends = self.ends(catenary);
        match &self.contacts[catenary] {
            None => StraightLine::new(ends[0], ends[1]).chord,
            Some(contact) => {
                let [a, b] = contact.point().map(constant);
                let along =
                    contact.line.length() + contact.excess_length[0] + contact.excess_length[1];
                let factor = self.factors.length[class(self.kind(catenary))];
                StraightLine::new(ends[0], a).chord
                    + StraightLine::new(b, ends[1]).chord
                    + factor * along
            }
        }
    }

    /// A span of a catenary along a line, with free ends.
    pub fn element(
        &self,
        catenary: usize,
        segment: usize,
        line: &StraightLine<T>,
        length: T,
    ) -> Element<T> {
        let kind = self.kind(catenary);
        let (section, class) = (self.ply.line(kind), class(kind));
        let mut element = Element {
            catenary,
            kind,
            segment,
            run: line.run,
            rise: line.rise,
            length,
            weight: self.factors.weight[class] * (section.mass * self.settings.gravity),
            rigidity: self.factors.rigidity[class] * section.flexural_rigidity,
            ends: [End::Free; 2],
            state: SpanState::Straight,
        };
        let longest = length.re().max(line.chord.re());
        if line.run.re() > self.tuning.vertical_run * longest {
            element.state = element.span(self.settings.axial_stiffness, &[]).state();
        }
        element
    }

    /// The free segment at an end of a catenary in contact; its slope at the gripper is left free.
    pub fn free_segment(
        &self,
        catenary: usize,
        contact: &ContactSegment,
        end: usize,
        line: &StraightLine<T>,
    ) -> Element<T> {
        let kind = self.kind(catenary);
        let length = T::from(contact.free_length(end)) * self.factors.length[class(kind)];
        let mut element = self.element(catenary, end, line, length);
        element.ends[1 - end] = self.contact_end(kind, contact, end, line);
        element
    }

    /// What holds a free segment where it leaves the mold.
    fn contact_end(
        &self,
        kind: Kind,
        contact: &ContactSegment,
        end: usize,
        line: &StraightLine<T>,
    ) -> End<T> {
        match self.settings.contact.end {
            ContactEnd::Free => End::Free,
            ContactEnd::Tangent => {
                let ([nx, ny, nz], heading) = (contact.normal[end], line.heading());
                if self.ply.line(kind).flexural_rigidity == 0.0 || nz <= 0.0 {
                    return End::Free;
                }
                End::Prescribed((heading[0] * -nx + heading[1] * -ny) / nz)
            }
        }
    }
}
