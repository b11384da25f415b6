//! Newton's method for θ and the end forces, and the continuation that leads it to the hanging solution.
//!
//! With test functions φ the moment balance (20) and the two ends are, on a strip of unit length and weight,
//!
//! *∫ M(θ') φ' + (H sin θ − V cos θ) φ ds = 0*, *∫ cos θ ds = ℓ*, *∫ sin θ ds = h*,
//!
//! the stationarity of the energy with the forces H and V₁ as multipliers: the matrix is symmetric, a band with two more rows.
//! A moment at a free end is zero by itself.

use super::band::Band;
use super::flexible::Flexible;
use super::panels::{DEGREE, NODES, POINTS, Panels, RULE};
use super::shape::Shape;
use super::tuning::TUNING;
use super::{Bending, Cantilever, HeavyStrip};
use crate::Error;
use crate::catenary::EndCondition;

/// Solution and problem of a strip of unit length and weight.
#[derive(Debug, Clone)]
struct StripState {
    /// θ at the nodes (rad).
    angle: Vec<f64>,
    /// Horizontal force, and vertical force at the second end.
    force: [f64; 2],
}

/// What Newton's method is to meet.
struct Goal<'a> {
    panels: &'a Panels,
    bending: &'a Bending,
    /// Length of the strip (m), and w L² (N·m), which turn curvatures and moments into those of the strip.
    scale: [f64; 2],
    /// Times as stiff as the strip.
    stiffer: f64,
    /// Rigidity of a strip without a curve (N·m²), and how far the bending has come from it, 0 to 1, to its own.
    blend: (f64, f64),
    /// θ at each end that is held (rad).
    held: [Option<f64>; 2],
    /// Run and rise; `None` where the second end hangs.
    ends: Option<[f64; 2]>,
}

impl HeavyStrip {
    /// Finds how the strip hangs.
    ///
    /// # Errors
    /// [`Error::StripTaut`] without slack, [`Error::StripRange`] if a number makes no sense, [`Error::StripLimp`] if a slope is prescribed
    /// without stiffness, [`Error::StripNotFound`] if the continuation comes to no end.
    pub fn solve(&self) -> Result<Shape, Error> {
        let (length, chord) = (self.length, self.run.hypot(self.rise));
        positive("the run", self.run)?;
        positive("the length", length)?;
        positive("the weight per length", self.weight)?;
        sound(&self.bending)?;
        let slopes = self.ends.map(|end| match end {
            EndCondition::Free => None,
            EndCondition::Slope(slope) => Some(slope),
        });
        for value in slopes.into_iter().flatten().chain([self.rise]) {
            if !value.is_finite() {
                let what = "the rise or a slope";
                return Err(Error::StripRange { what, value, range: "finite" });
            }
        }
        if length - chord <= TUNING.slack * length {
            let [length_mm, chord_mm] = [length, chord].map(|x| x * 1e3);
            return Err(Error::StripTaut { length_mm, chord_mm });
        }
        let rigidity = self.bending.rigidity();
        if rigidity == 0.0 && slopes.iter().any(Option::is_some) {
            return Err(Error::StripLimp);
        }

        // The flexible catenary, and panels that resolve it and the layers at its ends.
        let (run, rise) = (self.run / length, self.rise / length);
        let flexible = Flexible::new(run, rise);
        let cube = self.weight * length * length * length;
        let softest = (self.bending.least_rigidity() / cube).min(TUNING.start);
        let ends = [flexible.vertical_end - 1.0, flexible.vertical_end];
        let layers = ends.map(|vertical| {
            let tension = flexible.horizontal.hypot(vertical);
            (softest / tension).sqrt().min(softest.cbrt())
        });
        let panels = Panels::new(|s| flexible.angle(s), layers);
        let angle = (0..panels.nodes()).map(|n| flexible.angle(panels.place(n))).collect();
        let start = StripState { angle, force: [flexible.horizontal, flexible.vertical_end] };
        let scale = [length, self.weight * length * length];
        if rigidity == 0.0 {
            return Ok(Shape::new(panels, start.angle, start.force, &self.bending, scale));
        }

        // From an all but flexible strip with the catenary's own slopes to the strip.
        let softer = (TUNING.start * cube / rigidity).min(1.0);
        let own = [flexible.angle(0.0), flexible.angle(1.0)];
        let targets = slopes.map(|slope| slope.map(f64::atan));
        let goal = |share: f64| Goal {
            panels: &panels,
            bending: &self.bending,
            scale,
            stiffer: softer.powf(1.0 - share),
            blend: (rigidity, 1.0),
            held: [0, 1].map(|end| targets[end].map(|angle| own[end] + share * (angle - own[end]))),
            ends: Some([run, rise]),
        };
        let end = match continued(start.clone(), goal) {
            // A curve has kinks, and along an all but flexible strip the bending at a free end runs through all of them: then a
            // strip of one rigidity leads to the strip's stiffness, and its law is bent to the curve there.
            Err(Error::StripNotFound { .. }) if matches!(self.bending, Bending::Curve(_)) => {
                let straight = |share: f64| Goal { blend: (rigidity, 0.0), ..goal(share) };
                let end = continued(start, straight)?;
                continued(end, |share| Goal { blend: (rigidity, share), ..goal(1.0) })?
            }
            end => end?,
        };
        Ok(Shape::new(panels, end.angle, end.force, &self.bending, scale))
    }
}

impl Cantilever {
    /// Finds how the strip hangs.
    ///
    /// # Errors
    /// [`Error::StripRange`] if a number makes no sense, [`Error::StripLimp`] without stiffness, [`Error::StripNotFound`] if the continuation
    /// comes to no end.
    pub fn solve(&self) -> Result<Shape, Error> {
        positive("the length", self.length)?;
        positive("the weight per length", self.weight)?;
        sound(&self.bending)?;
        let below_upright = self.angle.abs() < std::f64::consts::FRAC_PI_2;
        if !below_upright {
            let (what, range) = ("the angle of the clamp", "less than a right angle");
            return Err(Error::StripRange { what, value: self.angle, range });
        }
        let rigidity = self.bending.rigidity();
        if rigidity == 0.0 {
            return Err(Error::StripLimp);
        }

        // From an all but straight strip to this one.
        let cube = self.weight * self.length.powi(3);
        let layer = (self.bending.least_rigidity() / cube).cbrt();
        let panels = Panels::new(|_| self.angle, [layer, 1.0]);
        let start = StripState { angle: vec![self.angle; panels.nodes()], force: [0.0; 2] };
        let stiffer = (TUNING.stiff * cube / rigidity).max(1.0);
        let scale = [self.length, self.weight * self.length * self.length];
        let goal = |share: f64| Goal {
            panels: &panels,
            bending: &self.bending,
            scale,
            stiffer: stiffer.powf(1.0 - share),
            blend: (rigidity, 1.0),
            held: [Some(self.angle), None],
            ends: None,
        };
        let end = continued(start, goal)?;
        Ok(Shape::new(panels, end.angle, end.force, &self.bending, scale))
    }
}

fn positive(what: &'static str, value: f64) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Error::StripRange { what, value, range: "positive" })
}

fn sound(bending: &Bending) -> Result<(), Error> {
    let (what, value) = ("the rigidity", bending.rigidity());
    let good = match bending {
        Bending::Rigidity(rigidity) => *rigidity >= 0.0 && rigidity.is_finite(),
        Bending::Curve(curve) => curve.is_sound(),
    };
    let range = "zero or more, and a curve of the moment must rise from zero";
    if good { Ok(()) } else { Err(Error::StripRange { what, value, range }) }
}

/// Follows the solution from a start that all but solves `goal(0)` to `goal(1)`; steps are halved where Newton's method fails.
fn continued<'a>(start: StripState, goal: impl Fn(f64) -> Goal<'a>) -> Result<StripState, Error> {
    let mut state = goal(0.0).newton(&start).ok_or(Error::StripNotFound { reached: 0.0 })?;
    let (mut reached, mut step) = (0.0, TUNING.steps[0]);
    while reached < 1.0 {
        let to = f64::min(reached + step, 1.0);
        match goal(to).newton(&state) {
            Some(next) => {
                (state, reached) = (next, to);
                step *= 2.0;
            }
            None if step < TUNING.steps[1] => return Err(Error::StripNotFound { reached }),
            None => step *= 0.25,
        }
    }
    Ok(state)
}

impl Goal<'_> {
    /// Newton's method from a state; `None` where it does not converge, or ends in a loop.
    fn newton(&self, from: &StripState) -> Option<StripState> {
        let mut state = from.clone();
        let size = self.panels.nodes();
        for (end, node) in [(0, 0), (1, size - 1)] {
            if let Some(angle) = self.held[end] {
                state.angle[node] = angle;
            }
        }
        let mut matrix = Band::new(size, DEGREE);
        let mut columns = [vec![0.0; size], vec![0.0; size], vec![0.0; size]];
        for _ in 0..TUNING.iterations {
            let [mut missing, mut turned] = [self.ends.unwrap_or_default(), [0.0; 2]];
            self.assemble(&state, &mut matrix, &mut columns, &mut missing);
            for (end, node) in [(0, 0), (1, size - 1)] {
                if self.held[end].is_some() {
                    matrix.fix(node);
                    columns.iter_mut().for_each(|column| column[node] = 0.0);
                }
            }
            let borders = [columns[1].clone(), columns[2].clone()];
            if !matrix.factorize() {
                return None;
            }
            columns.iter_mut().for_each(|column| matrix.solve(column));

            // The two rows of the ends: borders · (r − C f) = missing, f the change of the forces.
            if self.ends.is_some() {
                let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
                let m = [0, 1].map(|i| [0, 1].map(|j| dot(&borders[i], &columns[1 + j])));
                let r = [0, 1].map(|i| dot(&borders[i], &columns[0]) - missing[i]);
                let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
                turned = [
                    (r[0] * m[1][1] - r[1] * m[0][1]) / determinant,
                    (r[1] * m[0][0] - r[0] * m[1][0]) / determinant,
                ];
            }
            let step =
                |n: usize| columns[0][n] - columns[1][n] * turned[0] - columns[2][n] * turned[1];
            let largest = (0..size).map(|n| step(n).abs()).fold(0.0, f64::max);
            if !(largest.is_finite() && turned.iter().all(|f| f.is_finite())) {
                return None;
            }
            let share = (TUNING.largest_turn / largest).min(1.0);
            for n in 0..size {
                state.angle[n] += share * step(n);
            }
            for n in 0..2 {
                state.force[n] += share * turned[n];
            }
            if largest < TUNING.small_turn {
                let loops = state.angle.iter().any(|angle| angle.abs() > std::f64::consts::PI);
                return (!loops).then_some(state);
            }
        }
        None
    }

    /// Moment (N·m) and its slope (N·m²) at a curvature (1/m).
    fn bend(&self, curvature: f64) -> [f64; 2] {
        let (rigidity, share) = self.blend;
        let [moment, slope] = self.bending.bend(curvature);
        let mixed = |own: f64, straight: f64| share * own + (1.0 - share) * straight;
        [mixed(moment, rigidity * curvature), mixed(slope, rigidity)]
    }

    /// The matrix, minus the residual (first column), the derivatives of the residual by the two forces, and what the ends
    /// miss of their places.
    fn assemble(
        &self,
        state: &StripState,
        matrix: &mut Band,
        columns: &mut [Vec<f64>; 3],
        missing: &mut [f64; 2],
    ) {
        matrix.clear();
        columns.iter_mut().for_each(|column| column.fill(0.0));
        let [length, moments] = self.scale;
        let [horizontal, vertical_end] = state.force;
        for panel in 0..self.panels.count() {
            let (from, width) = self.panels.panel(panel);
            let first = DEGREE * panel;
            let angles = &state.angle[first..first + NODES];
            for q in 0..POINTS {
                let basis = &RULE.basis[q];
                let sum = |values: &[f64; NODES]| -> f64 {
                    values.iter().zip(angles).map(|(v, angle)| v * angle).sum()
                };
                let (sin, cos) = sum(&basis.value).sin_cos();
                let weight = RULE.weight[q] * width;
                let vertical = vertical_end - (1.0 - from - width * RULE.place[q]);

                // moment and its slope at the curvature of the strip
                let [moment, slope] = self.bend(sum(&basis.slope) / width / length);
                let moment = self.stiffer * moment / moments;
                let slope = self.stiffer * slope / (moments * length);

                let across = horizontal * sin - vertical * cos;
                let along = horizontal * cos + vertical * sin;
                missing[0] -= weight * cos;
                missing[1] -= weight * sin;
                for i in 0..NODES {
                    let (value, rate) = (basis.value[i], basis.slope[i] / width);
                    columns[0][first + i] -= weight * (moment * rate + across * value);
                    columns[1][first + i] += weight * sin * value;
                    columns[2][first + i] -= weight * cos * value;
                    for j in 0..NODES {
                        let (other, its_rate) = (basis.value[j], basis.slope[j] / width);
                        let entry = weight * (slope * rate * its_rate + along * value * other);
                        matrix.add(first + i, first + j, entry);
                    }
                }
            }
        }
        // d(run)/dθ = −sin θ and d(rise)/dθ = cos θ are minus the columns: −columns · step = missing
        *missing = missing.map(|m| -m);
    }
}
