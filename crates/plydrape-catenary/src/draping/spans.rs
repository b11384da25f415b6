//! The free spans of a solved ply as curves in space.

use crate::catenary::{Profile, SpanState};
use crate::equilibrium::{Solved, Solver, StateTangent};
pub use crate::geometry::Point;
use crate::mold::distance;
use crate::ply::{ContactSegment, Ply};
use std::sync::OnceLock;

/// One free span as it hangs, or a line that a stretched diagonal draws.
#[derive(Debug, Clone)]
pub struct FreeSpan {
    /// Index of its catenary.
    pub catenary: usize,
    /// 0 for a whole catenary or the free segment before the contact segment, 1 for the free segment after it.
    pub segment: usize,
    /// The element of the solver's problem that it is; `None` for a line that a stretched diagonal draws.
    pub element: Option<usize>,
    /// Ends (m).
    pub ends: [Point; 2],
    /// Fabric length (m).
    pub length: f64,
    /// Fabric arc length of its first end from the first gripper (m).
    pub start: f64,
    /// Closed form; `None` for a straight line.
    pub profile: Option<Profile>,
    /// Length of that curve (m), once it has been evaluated.
    pub curve: OnceLock<f64>,
    /// How it holds its length.
    pub state: SpanState,
    /// Whether it belongs to a stretched diagonal.
    pub shearing: bool,
    /// Horizontal force (N), where the model gives one.
    pub force: Option<f64>,
    /// Slopes at its ends.
    pub slopes: [f64; 2],
    /// Which slopes were prescribed.
    pub prescribed: [bool; 2],
}

impl FreeSpan {
    /// Horizontal distance of its ends (m).
    #[must_use]
    pub fn run(&self) -> f64 {
        // `hypot` would be slower, and this is needed at every station whenever gaps are sampled
        let ([a, b], square) = (self.ends, |x: f64| x * x);
        (square(b[0] - a[0]) + square(b[1] - a[1])).sqrt()
    }

    /// Straight distance of its ends (m).
    #[must_use]
    pub fn chord(&self) -> f64 {
        distance(self.ends[0], self.ends[1])
    }

    /// Length of the curve that it hangs in (m): its fabric length and its elastic stretch.
    #[must_use]
    pub(crate) fn curve_length(&self) -> f64 {
        match &self.profile {
            // needed many times, and a quadrature each
            Some(profile) => *self.curve.get_or_init(|| profile.length_to(self.run())),
            None => self.chord(),
        }
    }

    /// Horizontal unit vector from its first end to its second; zero if they lie above each other.
    #[must_use]
    pub fn heading(&self) -> [f64; 2] {
        let ([a, b], run) = (self.ends, self.run());
        if run > 0.0 { [(b[0] - a[0]) / run, (b[1] - a[1]) / run] } else { [0.0; 2] }
    }

    /// Point at a fraction `t` of its run (m).
    #[must_use]
    pub fn point(&self, t: f64) -> Point {
        let [a, b] = self.ends;
        let line = [0, 1, 2].map(|n| a[n] + t * (b[n] - a[n]));
        match &self.profile {
            Some(profile) => [line[0], line[1], a[2] + profile.station(t * self.run()).z],
            None => line,
        }
    }

    /// Points (m) at `N` stations at equal shares of its run, both ends included: to rounding as from
    /// [`FreeSpan::point`], in a fraction of the time.
    #[must_use]
    pub fn stations<const N: usize>(&self) -> [Point; N] {
        let [a, b] = self.ends;
        let line = |n: usize, c: usize| a[c] + n as f64 / (N - 1) as f64 * (b[c] - a[c]);
        match &self.profile {
            Some(profile) => {
                let heights: [f64; N] = profile.heights();
                std::array::from_fn(|n| [line(n, 0), line(n, 1), a[2] + heights[n]])
            }
            None => std::array::from_fn(|n| [line(n, 0), line(n, 1), line(n, 2)]),
        }
    }

    /// How its point at a fixed fraction `t` of its run changes (m) along a direction that moves its ends by
    /// `ends` (m) and the solved state by `tangent`.
    #[must_use]
    pub fn point_tangent(&self, t: f64, ends: [Point; 2], tangent: &StateTangent) -> Point {
        let [a, b] = ends;
        let line = [0, 1, 2].map(|n| a[n] + t * (b[n] - a[n]));
        let (Some(profile), Some(element)) = (&self.profile, self.element) else { return line };
        let ([first, second], [run, rise, length], [weight, rigidity]) =
            (tangent.end_slopes[element], tangent.spans[element], tangent.loads[element]);
        let force = tangent.force[element];
        // in the order of the closed form's variables
        let change = [force, first, second, run, rise, weight, rigidity, length];
        let height = profile.stations().height(t);
        let above: f64 =
            height.gradient.iter().zip(change).map(|(slope, change)| slope * change).sum();
        [line[0], line[1], a[2] + above]
    }

    /// Slope at a fraction `t` of its run.
    #[must_use]
    pub fn slope(&self, t: f64) -> f64 {
        match &self.profile {
            Some(profile) => profile.station(t * self.run()).slope,
            None if self.run() > 0.0 => (self.ends[1][2] - self.ends[0][2]) / self.run(),
            None => 0.0,
        }
    }

    /// Fabric arc length from its first end to a fraction `t` of its run (m). It grows to exactly
    /// [`FreeSpan::length`]: the elastic stretch is spread evenly.
    #[must_use]
    pub fn arc(&self, t: f64) -> f64 {
        if t >= 1.0 {
            return self.length;
        }
        let share = match &self.profile {
            Some(profile) => profile.length_to(t * self.run()) / self.curve_length(),
            None => t,
        };
        share.clamp(0.0, 1.0) * self.length
    }
}

/// A ply that hangs: all of its free spans, catenary by catenary, each with its force and its slopes.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    /// Free spans, in the order of catenaries and free segments.
    pub spans: Vec<FreeSpan>,
    /// How it was found.
    pub solved: Solved,
}

impl Equilibrium {
    /// Horizontal force (N) of each free span; `None` for a stretched diagonal or a straight span.
    pub fn forces(&self) -> impl Iterator<Item = Option<f64>> {
        self.spans.iter().map(|span| span.force)
    }

    /// The ply that a solver has just solved, at the positions (m) and contact segments that it solved for.
    #[must_use]
    pub fn new(
        ply: &Ply,
        solver: &Solver,
        solved: Solved,
        positions: &[Point],
        contacts: &[Option<ContactSegment>],
    ) -> Equilibrium {
        let lines = ply.lines();
        let problem = solver.problem();
        let mut elements = problem.elements.iter().enumerate().peekable();
        let mut spans = Vec::with_capacity(2 * lines.catenaries());
        for catenary in 0..lines.catenaries() {
            let grippers = lines.ends(catenary).map(|gripper| positions[gripper]);
            let stretched = problem.stretched(catenary).filter(|_| contacts[catenary].is_none());
            let segments = contacts[catenary].as_ref().map_or(1, |_| 2);
            for segment in 0..segments {
                let ends = match &contacts[catenary] {
                    None => grippers,
                    Some(contact) if !contact.hangs(segment) => {
                        debug_assert!(contact.free_length(segment) >= -1e-12);
                        continue;
                    }
                    Some(contact) if segment == 0 => [grippers[0], contact.point()[0]],
                    Some(contact) => [contact.point()[1], grippers[1]],
                };
                let start = contacts[catenary]
                    .as_ref()
                    .map_or(0.0, |l| if segment == 0 { 0.0 } else { l.arc()[1] });
                let mut span = FreeSpan {
                    catenary,
                    segment,
                    element: None,
                    ends,
                    length: 0.0,
                    start,
                    profile: None,
                    curve: OnceLock::new(),
                    state: SpanState::Straight,
                    shearing: stretched.is_some(),
                    force: None,
                    slopes: [0.0; 2],
                    prescribed: [false; 2],
                };
                span.slopes = [span.slope(0.0); 2];
                // a fold has no catenary
                span.length = contacts[catenary].as_ref().map_or(0.0, |l| l.free_length(segment));
                if let Some(path) = stretched {
                    span.length = path;
                } else if let Some((n, element)) =
                    elements.next_if(|(_, e)| e.catenary == catenary && e.segment == segment)
                {
                    span.element = Some(n);
                    span.length = element.length;
                    span.state = element.state;
                    span.force = solver.force(n);
                    if let Some(force) = span.force {
                        span.profile = Some(Profile::new(&solver.span(n), force));
                        span.slopes = solver.end_slopes(n);
                        span.prescribed = solver.holds(n);
                    }
                }
                spans.push(span);
            }
        }
        Equilibrium { spans, solved }
    }
}
