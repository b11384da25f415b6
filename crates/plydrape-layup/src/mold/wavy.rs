//! Waves on a mold: what is left of its waviness when it is said to be made to size.
//!
//! They are a height along the normal of the mold, see [`super::Raised`]: a sum of a few sine waves over the plan with directions
//! and phases of their own. Waves are long against their height and against a mold's bends.

use super::raised::{Raise, Relief};
use std::f64::consts::TAU;

/// Number of sine waves: of fewer one sees the directions, more of them change nothing but the time.
const COUNT: usize = 6;

/// A sum of sine waves over the plan, of one length and height.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Waves {
    /// Height of each wave above its middle (m).
    pub amplitude: f64,
    /// Length of each wave (m).
    pub wavelength: f64,
    /// Direction in plan in which each wave runs, from x to y (rad).
    pub headings: [f64; COUNT],
    /// Phase of each wave at the origin (rad).
    pub phases: [f64; COUNT],
}

impl Waves {
    /// Amplitude (m) of each wave for a standard deviation of the height (m): the squares of waves add up, each ½.
    #[must_use]
    pub fn amplitude_of_deviation(deviation: f64) -> f64 {
        deviation / (0.5 * COUNT as f64).sqrt()
    }

    /// Amplitude (m) of each wave for a height that no point exceeds (m).
    #[must_use]
    pub fn amplitude_of_bound(bound: f64) -> f64 {
        bound / COUNT as f64
    }
}

impl Relief for Waves {
    fn most(&self) -> f64 {
        COUNT as f64 * self.amplitude.abs()
    }

    fn steepest(&self) -> f64 {
        self.most() * TAU / self.wavelength
    }

    fn at(&self, [x, y, _]: [f64; 3]) -> Raise {
        let number = TAU / self.wavelength;
        let mut wave = Raise { height: 0.0, gradient: [0.0; 3], hessian: [0.0; 3] };
        for (heading, phase) in self.headings.into_iter().zip(self.phases) {
            let (b, a) = heading.sin_cos();
            let (sin, cos) = (number * (a * x + b * y) + phase).sin_cos();
            wave.height += self.amplitude * sin;
            let slope = self.amplitude * number * cos;
            wave.gradient[0] += slope * a;
            wave.gradient[1] += slope * b;
            let bend = -self.amplitude * number * number * sin;
            for (sum, square) in wave.hessian.iter_mut().zip([a * a, a * b, b * b]) {
                *sum += bend * square;
            }
        }
        wave
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vector::{along, distance};
    use crate::mold::{Cylinder, Face, Graph, Mold, Plane, Pose, Raised, Saddle, Sphere, Surface};

    /// Slopes of up to 0.03 on waves of 150 mm.
    fn waves() -> Waves {
        Waves {
            amplitude: 2e-4,
            wavelength: 0.15,
            headings: [0.3, 1.4, 2.2, 3.9, 4.4, 5.8],
            phases: [0.1, 2.0, 4.1, 5.0, 0.7, 3.3],
        }
    }

    /// One of each way to be asked, with waves.
    fn molds() -> Vec<Mold> {
        let pose = Pose::new([0.02, -0.01, -0.4], [0.1, 0.05, 0.3]);
        let saddle = Surface::Saddle(Saddle { radii: [0.6, 0.9] });
        let flat = Pose::new([0.0; 3], [0.1, -0.1, 0.5]);
        let plain = vec![
            Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] }),
            Mold::Plane(Plane { point: [0.0; 3], normal: [-0.28, 0.0, 0.96] }),
            Mold::Sphere(Sphere { pose, radius: 0.4, face: Face::Outside }),
            Mold::Cylinder(Cylinder { pose, radius: 0.4, face: Face::Outside }),
            Mold::Graph(Graph { pose: flat, surface: saddle, domain: None }),
        ];
        let wavy = |mold| Mold::Wavy(std::sync::Arc::new(Raised { mold, relief: waves() }));
        plain.into_iter().map(wavy).collect()
    }

    /// Places in plan (m), none of them special.
    const PLACES: [[f64; 2]; 4] = [[0.013, 0.027], [-0.05, 0.04], [0.09, -0.06], [-0.02, -0.08]];

    /// Gradient and second derivatives of the waves are those of central differences.
    #[test]
    fn the_slopes_and_bends_of_waves_are_their_derivatives() {
        let (waves, h) = (waves(), 1e-5);
        for [x, y] in PLACES {
            let places = [[x, y], [x + h, y], [x - h, y], [x, y + h], [x, y - h]];
            let [wave, px, mx, py, my] = places.map(|[x, y]| waves.at([x, y, 0.0]));
            let slope = |a: &Raise, b: &Raise| (a.height - b.height) / (2.0 * h);
            let bend = |a: &Raise, b: &Raise, n: usize| (a.gradient[n] - b.gradient[n]) / (2.0 * h);
            let near =
                |a: f64, b: f64, scale: f64| assert!((a - b).abs() < 1e-6 * scale, "{a} {b}");
            near(wave.gradient[0], slope(&px, &mx), waves.steepest());
            near(wave.gradient[1], slope(&py, &my), waves.steepest());
            let number = TAU / waves.wavelength;
            near(wave.hessian[0], bend(&px, &mx, 0), waves.steepest() * number);
            near(wave.hessian[1], bend(&px, &mx, 1), waves.steepest() * number);
            near(wave.hessian[2], bend(&py, &my, 1), waves.steepest() * number);
        }
    }

    /// On the level plane the surface is z = w(x, y): closest points lie on it, and so do the highest points.
    #[test]
    fn a_level_plane_with_waves_is_the_height_of_the_waves() {
        let mold = &molds()[0];
        for [x, y] in PLACES {
            let top = mold.highest_point([x, y]).expect("a point");
            assert!((top[2] - waves().at([x, y, 0.0]).height).abs() < 1e-15);
            let closest = mold.closest_point([x, y, 0.01]);
            let [px, py, pz] = closest.point;
            assert!((pz - waves().at([px, py, 0.0]).height).abs() < 1e-13);
        }
    }

    /// Closest points are on the mold, as far away as the distance says and along the normal, to the second order of the slope.
    #[test]
    fn the_closest_point_lies_on_the_mold_along_the_normal() {
        for mold in molds() {
            for [x, y] in PLACES {
                let top = mold.highest_point([x, y]).expect("a point");
                assert!(mold.signed_distance(top).abs() < 1e-13);
                for height in [-1e-3, 1e-4, 0.02] {
                    let p = [top[0], top[1], top[2] + height];
                    let closest = mold.closest_point(p);
                    assert!(mold.signed_distance(closest.point).abs() < 1e-13);
                    let slope = waves().steepest();
                    let off = distance(p, closest.point) - closest.distance.abs();
                    assert!(off.abs() < slope * slope * height.abs(), "{off} {height}");
                    assert_eq!(mold.separation(p, f64::INFINITY).distance, closest.distance);
                    let along = along(closest.point, closest.distance, closest.normal);
                    assert!(distance(p, along) < 2.0 * slope * height.abs());
                }
            }
        }
    }

    /// The normal is the derivative of the signed distance: on the mold by central differences to the order of wave height times
    /// the mold's curvature, and above it to the order of what the formula leaves out.
    #[test]
    fn the_gradient_of_the_distance_is_the_normal() {
        let h = 1e-6;
        for (n, mold) in molds().iter().enumerate() {
            for [x, y] in PLACES {
                let top = mold.highest_point([x, y]).expect("a point");
                for height in [0.0, 1e-3] {
                    let p = [top[0], top[1], top[2] + height];
                    let gradient = mold.distance_gradient(p, &mold.closest_point(p));
                    let central = [0, 1, 2].map(|axis| {
                        let distance_at = |by: f64| {
                            let mut q = p;
                            q[axis] += by;
                            mold.signed_distance(q)
                        };
                        (distance_at(h) - distance_at(-h)) / (2.0 * h)
                    });
                    let slope = waves().steepest();
                    let bend = slope * TAU / waves().wavelength;
                    // curvatures are up to 2.5/m, heights up to the waves' and that of the point
                    let curved = if n < 2 { 0.0 } else { 2.5 };
                    let left_out = slope * (height * bend + (height + waves().most()) * curved);
                    let off = distance(gradient, central);
                    assert!(off < left_out + 1e-9, "mold {n} at {height}: {off} {left_out}");
                }
            }
        }
    }

    /// Curvatures are those of the height: on a level plane along x by the second derivative, up to the square of the slope.
    #[test]
    fn a_wave_curves_by_its_second_derivative() {
        let mold = &molds()[0];
        let slope = waves().steepest();
        for [x, y] in PLACES {
            let p = mold.highest_point([x, y]).expect("a point");
            let [xx, xy, yy] = waves().at(p).hessian;
            let curvatures = mold.curvatures(p);
            let scale = slope * TAU / waves().wavelength;
            for angle in [0.0, 0.4, 1.1, 2.6_f64] {
                let (b, a) = angle.sin_cos();
                let bend = -(xx * a * a + 2.0 * xy * a * b + yy * b * b);
                let found = curvatures.along([a, b, 0.0]);
                assert!((found - bend).abs() < 3.0 * slope * slope * scale, "{found} {bend}");
            }
        }
    }

    /// A path along the mold is as long as its points are apart, lies on the mold, and leads to its end.
    #[test]
    fn a_path_lies_on_the_mold() {
        for mold in molds() {
            let [a, b] = [PLACES[1], PLACES[2]].map(|xy| mold.highest_point(xy).expect("a point"));
            let path = mold.path(a, b).expect("a path");
            assert!(distance(path.end(), b) < 1e-5 * distance(a, b));
            assert!(path.points.iter().all(|p| mold.signed_distance(*p).abs() < 1e-12));
            let chords: f64 = path.points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
            assert!((chords / path.length() - 1.0).abs() < 1e-4 && chords < path.length());
        }
    }

    /// No point of the mold is in the ball that is said to be clear.
    #[test]
    fn a_clear_ball_holds_nothing_of_the_mold() {
        for mold in molds() {
            for [x, y] in PLACES {
                let top = mold.highest_point([x, y]).expect("a point");
                for height in [1e-4, 5e-3, 0.05] {
                    let p = [top[0], top[1], top[2] + height];
                    let apart = mold.separation(p, f64::INFINITY);
                    let radius = mold.clear(p, apart, mold.steepness());
                    assert!(radius > 0.5 * height * 0.7 - 1e-3 * height, "{radius} {height}");
                    assert!(distance(p, mold.closest_point(p).point) >= radius);
                    for [u, v, w] in
                        [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [-0.6, 0.0, -0.8], [0.0, 0.6, -0.8]]
                    {
                        let q = along(p, 0.999 * radius, [u, v, w]);
                        assert!(mold.signed_distance(q) > 0.0);
                    }
                }
            }
        }
    }
}
