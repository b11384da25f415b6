//! Named sets of limits, with a source for each figure.
//!
//! A preset sets what its source speaks of and leaves the other limits as they are. It is no standard, and a drape that keeps
//! it conforms to none: the figures say what others have asked for, and which part may be accepted is for its designer to say.

use super::Name;

/// A named set of limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Preset {
    /// Tolerances that the project DrapeBot gives for draping.
    #[cfg_attr(feature = "serde", serde(rename = "drapebot"))]
    DrapeBot,
    /// No place higher than half a millimeter.
    LowWrinkle,
    /// A usual tolerance of the angle of a ply, in its plane and out of it.
    PlyAngle,
}

/// One limit of a preset.
#[derive(Debug, Clone, Copy)]
pub struct Figure {
    /// What it bounds.
    pub name: Name,
    /// The limit, in SI units.
    pub value: f64,
    /// Where it comes from.
    pub source: &'static str,
}

/// What DrapeBot says.
const DRAPEBOT: &str = "\"tolerances going down to ±2 mm for positioning and ±3° for fiber orientation\": project \
DrapeBot, Horizon 2020 grant 101006732, periodic report 2, 2022-07 to 2023-12, cordis.europa.eu/project/id/101006732/reporting";
/// What the manual says.
const PLY_ANGLE: &str = "\"typical repair tolerance for ply alignment\" of ±3°: US Army TM 1-1500-204-23-11, General \
Aircraft Maintenance, Sheet Metal Shop, paragraph 5-6 e (1); read in a web copy that has lost the signs ± and °";
/// Angle, taken out of the plane too.
const OUT_OF_PLANE: &str =
    "a choice of this program: the same angle out of the plane of the ply; no source gives it";
/// The slack of that angle.
const SLACK: &str =
    "a choice of this program: the same angle for slack ε, as 2√ε; no source gives it";
/// Half a millimeter.
const HEIGHT: &str = "a choice of this program, its default limit of the sheet; no source gives it";
/// Where the limit of wrinkles comes from.
const WRINKLE: &str = "as height, for the ruck that the slack of a catenary makes";

/// Three degrees (rad).
const THREE_DEGREES: f64 = 3.0 * std::f64::consts::PI / 180.0;

impl Preset {
    /// All of them, by name.
    pub const ALL: &[Preset] = &[Preset::DrapeBot, Preset::LowWrinkle, Preset::PlyAngle];

    /// Name in scenes.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Preset::DrapeBot => "drapebot",
            Preset::LowWrinkle => "low-wrinkle",
            Preset::PlyAngle => "ply-angle",
        }
    }

    /// What it is, in a line.
    #[must_use]
    pub fn about(self) -> &'static str {
        match self {
            Preset::DrapeBot => "tolerances that the EU project DrapeBot gives for draping",
            Preset::LowWrinkle => "nothing higher over the mold than half a millimeter",
            Preset::PlyAngle => "a usual tolerance of ply angles, also out of the plane",
        }
    }

    /// Limits, each with its source.
    #[must_use]
    pub fn figures(self) -> &'static [Figure] {
        const fn figure(name: Name, value: f64, source: &'static str) -> Figure {
            Figure { name, value, source }
        }
        match self {
            Preset::DrapeBot => {
                const {
                    &[
                        figure(Name::Position, 2e-3, DRAPEBOT),
                        figure(Name::FiberAngle, THREE_DEGREES, DRAPEBOT),
                    ]
                }
            }
            Preset::LowWrinkle => {
                const { &[figure(Name::Height, 5e-4, HEIGHT), figure(Name::Wrinkle, 5e-4, WRINKLE)] }
            }
            Preset::PlyAngle => {
                const {
                    &[
                        figure(Name::FiberAngle, THREE_DEGREES, PLY_ANGLE),
                        figure(Name::OutOfPlane, THREE_DEGREES, OUT_OF_PLANE),
                        figure(Name::SlackAngle, THREE_DEGREES, SLACK),
                    ]
                }
            }
        }
    }

    /// Value for a limit (SI), if it has one.
    #[must_use]
    pub fn value(self, name: Name) -> Option<f64> {
        self.figures().iter().find(|figure| figure.name == name).map(|figure| figure.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nobody reads a promise out of a preset: it names no standard as kept.
    #[test]
    fn no_preset_claims_conformity() {
        for preset in Preset::ALL {
            let sources = preset.figures().iter().map(|figure| figure.source);
            for text in sources.chain([preset.about()]) {
                for word in ["conform", "complies", "compliant", "certif", "in accordance"] {
                    assert!(!text.to_lowercase().contains(word), "{text}");
                }
            }
        }
    }
}
