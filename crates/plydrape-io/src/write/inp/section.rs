//! The shell section: one homogeneous layer that bends, stretches and weighs as the model's ply does.
//!
//! A fabric is no plate. Its fibers slide when it bends, so that it bends far more easily than its thickness and its
//! fibers' stiffness would have it. A homogeneous shell of thickness h has, per width,
//!
//! ```text
//! membrane  A = E h        bending  D = E h³/12        so that  h = √(12 D/A),  E = A/h
//! ```
//!
//! D is the material's flexural rigidity per width. A is that of the export, 2·10⁴ N/m unless given: far below a yarn's, with which
//! every turn within an iteration makes false tension, and the hanging step stands still.
//! So h and E follow, and neither is the ply's: h is an *effective* thickness (0.23 mm for the paper's ply, whose true
//! one is tenths of a millimeter), E an effective modulus, and the density is the areal mass over h. With different
//! rigidities in warp and weft one h cannot meet both membranes: both rigidities are exact, and the geometric mean of the
//! membranes is.
//!
//! In shear G h = dτ/dγ of the material's curve at small angle. Without a curve the model leaves the shear free; a shell
//! needs some. Poisson's ratios are zero: crossing fibers do not know of each other. Transverse shear is as stiff as
//! half the fibers, which leaves bending to be bending.
//!
//! Where mass and rigidity are given per catenary, the ply is that of strips √(ab) wide, of a single strip b wide. The
//! shape depends on EI/m alone, forces on the width.

use crate::result::SceneEcho;
use crate::store::shown::millimeters;
use plydrape::material::Section;
use plydrape::ply::Direction;

/// Shear stiffness where the material has no shear curve (N/m per rad): small beside the fibers', and enough to solve.
const SHEAR: f64 = 100.0;
/// Least shear stiffness (N/m per rad) that a solver takes.
const LEAST_SHEAR: f64 = 10.0;
/// Shear angle (rad) to which the secant of a shear curve is taken.
const SMALL_ANGLE: f64 = 0.1;
/// Least bending length (D/μg)^⅓, as a share of a cell's side.
const LEAST_BENDING_LENGTH: f64 = 0.05;

/// A homogeneous orthotropic shell; 1 is along the warp, 2 along the weft.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ShellSection {
    /// Areal mass μ (kg/m²).
    pub areal_mass: f64,
    /// Bending rigidity per width D (N·m), warp and weft.
    pub rigidity: [f64; 2],
    /// Membrane stiffness per width A (N/m), geometric mean of warp and weft.
    pub membrane: f64,
    /// Shear stiffness per width G h (N/m per rad).
    pub shear: f64,
    /// Effective thickness h (m).
    pub thickness: f64,
    /// What is not the scene's own, in words, one line each.
    pub assumed: Vec<String>,
}

impl ShellSection {
    /// The section of a scene's ply.
    ///
    /// `membrane` is the membrane stiffness per width (N/m).
    pub fn new(scene: &SceneEcho, membrane: f64) -> ShellSection {
        let mut assumed = Vec::new();
        let [a, b] = scene.ply.cell;
        let width = if scene.ply.grid.nv == 1 { b } else { (a * b).sqrt() };
        let (areal_mass, mut rigidity) = match scene.ply.material.section {
            Section::Line { mass, flexural_rigidity } => {
                assumed.push(format!(
                    "Mass and rigidity are given per catenary: each stands for {} mm of width.",
                    millimeters(width)
                ));
                (mass / width, [flexural_rigidity / width; 2])
            }
            Section::Areal { mass, warp_rigidity, weft_rigidity } => {
                (mass, [warp_rigidity, weft_rigidity])
            }
        };

        if scene.ply.material.moment.iter().any(Option::is_some) {
            assumed.push(
                "The ply's moment over curvature is a table; the shells have its rigidity at rest, its first slope."
                    .into(),
            );
        }

        // what a solver cannot do: no bending
        let weight = areal_mass * scene.settings.gravity.abs().max(1.0);
        let side = a.min(b);
        let limp = weight * (LEAST_BENDING_LENGTH * side).powi(3);
        for (rigidity, fiber) in rigidity.iter_mut().zip(["warp", "weft"]) {
            if *rigidity < limp {
                assumed.push(format!(
                    "The ply's bending rigidity along the {fiber}, {rigidity:.3e} N m, is raised to {limp:.3e} N m: shells need some."
                ));
                *rigidity = limp;
            }
        }
        // shear
        let shear = match &scene.ply.material.shear_curve {
            None => {
                assumed.push(format!(
                    "The material has no shear curve: the shear stiffness of {SHEAR} N/m per rad is ASSUMED. Set G12 to yours."
                ));
                SHEAR
            }
            Some(curve) => {
                let secant = curve.force(SMALL_ANGLE).0 / SMALL_ANGLE;
                assumed.push(format!(
                    "Shear is linear, the secant of the material's shear curve to {SMALL_ANGLE} rad; it does not lock."
                ));
                if secant < LEAST_SHEAR {
                    assumed.push(format!(
                        "That secant, {secant:.3e} N/m per rad, is raised to {LEAST_SHEAR} N/m per rad: shells need some."
                    ));
                }
                secant.max(LEAST_SHEAR)
            }
        };

        let mean = (rigidity[0] * rigidity[1]).sqrt();
        let thickness = (12.0 * mean / membrane).sqrt();
        ShellSection { areal_mass, rigidity, membrane, shear, thickness, assumed }
    }

    /// Young's moduli E₁, E₂, E₃ (Pa); across the ply the mean of the fibers'.
    pub fn young(&self) -> [f64; 3] {
        let [first, second] = self.rigidity.map(|d| 12.0 * d / self.thickness.powi(3));
        [first, second, (first * second).sqrt()]
    }

    /// Shear moduli G₁₂, G₁₃, G₂₃ (Pa).
    pub fn shear_moduli(&self) -> [f64; 3] {
        let across = 0.5 * self.young()[2];
        [self.shear / self.thickness, across, across]
    }

    /// Density (kg/m³).
    pub fn density(&self) -> f64 {
        self.areal_mass / self.thickness
    }
}

/// Which way the warp runs in the ply: fabric directions of the material's axes 1 and 2, u × v being their normal too.
pub(super) fn axes(warp: Direction) -> [[f64; 2]; 2] {
    match warp {
        Direction::U => [[1.0, 0.0], [0.0, 1.0]],
        Direction::V => [[0.0, 1.0], [-1.0, 0.0]],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::material::ShearCurve;

    fn near(a: f64, b: f64) -> bool {
        (a / b - 1.0).abs() < 1e-12
    }

    /// The paper's ply: E h³/12 = EI/width, E h = EA/width and ρ h = m/width, nothing of them changed.
    #[test]
    fn the_section_has_the_ply_s_mass_bending_and_membrane() {
        let scene = sample::hanging(4, 2).scene;
        let section = ShellSection::new(&scene, 2e4);
        let h = section.thickness;
        let [warp, weft, _] = section.young();
        for modulus in [warp, weft] {
            assert!(near(modulus * h.powi(3) / 12.0, 9e-6 / 0.1));
            assert!(near(modulus * h, 2e4));
        }
        assert!(near(section.density() * h, 0.3143 / 0.1));
        assert!(near(section.shear_moduli()[0] * h, SHEAR));
        assert!((h - 2.324e-4).abs() < 1e-7, "0.23 mm as the header says: {h}");
    }

    /// With unlike rigidities both are exact; the membranes are in their proportion about the one given.
    #[test]
    fn unlike_rigidities_are_both_exact() {
        let mut scene = sample::hanging(3, 3).scene;
        scene.ply.material.section =
            Section::Areal { mass: 0.6, warp_rigidity: 4e-4, weft_rigidity: 1e-4 };
        let section = ShellSection::new(&scene, 3e4);
        let h = section.thickness;
        let [warp, weft, _] = section.young();
        assert!(near(warp * h.powi(3) / 12.0, 4e-4) && near(weft * h.powi(3) / 12.0, 1e-4));
        assert!(near(h * (warp * weft).sqrt(), 3e4));
        assert!(near(section.density() * h, 0.6));
    }

    /// A limp ply without resistance to shear is no shell: what is put in its place is said.
    #[test]
    fn what_shells_cannot_do_is_said() {
        let mut scene = sample::hanging(4, 2).scene;
        scene.ply.material.section = Section::Line { mass: 0.3143, flexural_rigidity: 0.0 };
        scene.ply.material.shear_curve =
            Some(ShearCurve::Polynomial { coefficients: vec![0.0, 0.0, 1.0] });
        let section = ShellSection::new(&scene, 2e4);
        assert!(section.thickness.is_finite() && section.thickness > 0.0);
        let said = section.assumed.join("\n");
        for word in ["warp", "weft", "shear curve", "raised to 10 N/m"] {
            assert!(said.contains(word), "{word} in {said}");
        }
    }

    /// A measured curve gives its secant: τ = 250 γ + 1000 γ³ at 0.1 rad is 26 N/m, so 260 N/m per rad.
    #[test]
    fn a_shear_curve_gives_its_secant() {
        let mut scene = sample::hanging(4, 2).scene;
        let coefficients = vec![250.0, 0.0, 1000.0];
        scene.ply.material.shear_curve = Some(ShearCurve::Polynomial { coefficients });
        assert!(near(ShellSection::new(&scene, 2e4).shear, 260.0));
    }
}
