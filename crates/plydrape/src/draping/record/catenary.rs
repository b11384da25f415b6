//! The catenaries of a step: kind, direction, spans, contact.

use crate::ply::GripperId;
use std::fmt;

/// Whether a catenary bounds cells or crosses one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum CatenaryKind {
    /// Along a fibre direction, between two cells or at the ply's border.
    Edge,
    /// Across a cell.
    Diagonal,
}

/// Where a catenary leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum CatenaryDirection {
    /// Along the first gripper index.
    U,
    /// Along the second gripper index.
    V,
    /// From `[i, j]` to `[i+1, j+1]`.
    Rising,
    /// From `[i+1, j]` to `[i, j+1]`.
    Falling,
}

/// What holds a span in its shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Hold {
    /// It hangs freely.
    Hanging,
    /// It is pulled straight beyond its length.
    Overstretched,
    /// It is straight: shearing, or taut without a force.
    Straight,
    /// It lies on the mold.
    Lying,
}

/// The word of the file.
macro_rules! words {
    ($name:ident: $($variant:ident $word:literal),*) => {
        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self { $($name::$variant => $word),* })
            }
        }
    };
}

words!(CatenaryKind: Edge "edge", Diagonal "diagonal");
words!(CatenaryDirection: U "u", V "v", Rising "rising", Falling "falling");
words!(Hold: Hanging "hanging", Overstretched "overstretched", Straight "straight", Lying "lying");

/// One catenary in one step.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct CatenaryState {
    /// `edge` or `diagonal`.
    pub kind: CatenaryKind,
    /// `u`, `v`, `rising` or `falling`.
    pub direction: CatenaryDirection,
    /// Gripper at its first end.
    pub from: GripperId,
    /// Gripper at its second end.
    pub to: GripperId,
    /// Set length (m).
    pub length: f64,
    /// A diagonal stretched by the shear of its cell: straight.
    pub shearing: bool,
    /// Force of a shearing diagonal (N), where the material has a shear curve.
    pub shear_force_n: Option<f64>,
    /// Rests, in order: those that hang, and those that lie on the mold with what slack they keep.
    pub spans: Vec<SpanState>,
    /// What the mold has caught.
    pub contact: Option<ContactState>,
    /// A touch away from the contact segment.
    pub bridging: Option<Bridging>,
}

/// One free span in one step.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct SpanState {
    /// Fabric arc length of its ends from the first gripper (m).
    pub arc: [f64; 2],
    /// Fabric length (m).
    pub length: f64,
    /// Horizontal distance of its ends (m).
    pub run: f64,
    /// Height of its second end above its first (m).
    pub rise: f64,
    /// Whether it hangs, is pulled or lies.
    pub state: Hold,
    /// Horizontal force (N); null where the model gives none.
    #[cfg_attr(feature = "serde", serde(rename = "H_N"))]
    pub force: Option<f64>,
    /// Slopes at its ends.
    pub slopes: [f64; 2],
    /// Which of these slopes were prescribed; the others are free.
    pub prescribed: [bool; 2],
    /// Its shape at equally spaced stations (m); slack of a lying rest is drawn as a wrinkle.
    pub points: Vec<[f64; 3]>,
    /// Free length minus the way between its ends (mm), not negative; a fold where the gripper has passed the contact.
    pub slack_mm: f64,
    /// Slack as a share of its free length.
    pub slack_ratio: f64,
    /// Height of the ruck that the slack makes on the mold (mm).
    pub wrinkle_mm: f64,
    /// Way beyond the free length (mm), not negative.
    pub overstretch_mm: f64,
    /// Way beyond the free length as a share of the whole catenary.
    pub overstretch: f64,
}

/// The segment of a catenary that the mold has caught; rests beside it may lie there too.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ContactState {
    /// Fabric arc length of its ends from the first gripper (m).
    pub arc: [f64; 2],
    /// Its line on the mold (m), first to last.
    pub points: Vec<[f64; 3]>,
    /// Distance of each of these points from its place in the ideal drape (mm); null where that is not
    /// known.
    pub landing_error_mm: Option<Vec<Option<f64>>>,
    /// Angle between the line, from end to end, and the same fabric in the ideal drape (°); edges only.
    pub fibre_angle_deg: Option<f64>,
}

/// A touch away from the contact segment, which the model does not follow.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Bridging {
    /// Place of the largest gap between segment and touch (m).
    pub place: [f64; 3],
    /// That gap (m).
    pub gap: f64,
    /// Straight distance between the touches on both sides of it (m).
    pub width: f64,
}
