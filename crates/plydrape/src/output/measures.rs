//! The measures of a step as tables and charts show them: name, unit, limit.

use crate::draping::record::{Measures, Worst};
use crate::scene::Limits;

/// A measure with a place.
pub struct Measure {
    /// Its key in the result file.
    pub key: &'static str,
    /// What it is called.
    pub label: &'static str,
    /// Unit of its value.
    pub unit: &'static str,
    /// What its place is called.
    pub place: &'static str,
    /// Its worst value in a step.
    pub find: fn(&Measures) -> Option<&Worst>,
    /// Its limit in the same unit, where there is one.
    pub limit: fn(&Limits) -> Option<f64>,
}

impl Measure {
    /// Its column in a table.
    #[must_use]
    pub fn header(&self) -> String {
        format!("{} ({})", self.label, self.unit)
    }

    /// Whether the limit is the least that is allowed.
    #[must_use]
    pub fn is_least(&self) -> bool {
        self.key == "gripper_distance_mm"
    }
}

/// Every measure with a place.
pub const MEASURES: [Measure; 14] = [
    Measure {
        key: "slack_mm",
        label: "slack",
        unit: "mm",
        place: "slack",
        find: |m| m.slack_mm.as_ref(),
        limit: |_| None,
    },
    Measure {
        key: "slack_ratio",
        label: "slack ratio",
        unit: "1",
        place: "slack ratio",
        find: |m| m.slack_ratio.as_ref(),
        limit: |l| Some(l.slack_ratio),
    },
    Measure {
        key: "wrinkle_mm",
        label: "wrinkle amplitude",
        unit: "mm",
        place: "wrinkle amplitude",
        find: |m| m.wrinkle_mm.as_ref(),
        limit: |_| None,
    },
    Measure {
        key: "overstretch",
        label: "overstretch",
        unit: "1",
        place: "overstretch",
        find: |m| m.overstretch.as_ref(),
        limit: |l| Some(l.overstretch),
    },
    Measure {
        key: "overstretch_mm",
        label: "overstretch",
        unit: "mm",
        place: "overstretch length",
        find: |m| m.overstretch_mm.as_ref(),
        limit: |_| None,
    },
    Measure {
        key: "bridging_mm",
        label: "bridging",
        unit: "mm",
        place: "bridging",
        find: |m| m.bridging_mm.as_ref(),
        limit: |l| Some(l.bridging * 1e3),
    },
    Measure {
        key: "shear_deg",
        label: "shear",
        unit: "deg",
        place: "shear",
        find: |m| m.shear_deg.as_ref(),
        limit: |l| Some(l.shear.to_degrees()),
    },
    Measure {
        key: "tilt_deg",
        label: "tilt",
        unit: "deg",
        place: "tilt",
        find: |m| m.tilt_deg.as_ref(),
        limit: |l| Some(l.tilt.to_degrees()),
    },
    Measure {
        key: "force_n",
        label: "horizontal force",
        unit: "N",
        place: "horizontal force",
        find: |m| m.force_n.as_ref(),
        limit: |l| l.force,
    },
    Measure {
        key: "landing_error_mm",
        label: "landing error",
        unit: "mm",
        place: "landing error",
        find: |m| m.landing_error_mm.as_ref(),
        limit: |l| Some(l.landing_contact * 1e3),
    },
    Measure {
        key: "fibre_angle_deg",
        label: "fibre angle",
        unit: "deg",
        place: "fibre angle",
        find: |m| m.fibre_angle_deg.as_ref(),
        limit: |l| Some(l.fibre_angle.to_degrees()),
    },
    Measure {
        key: "gap_mm",
        label: "gap",
        unit: "mm",
        place: "gap",
        find: |m| m.gap_mm.as_ref(),
        limit: |_| None,
    },
    Measure {
        key: "gripper_distance_mm",
        label: "gripper distance",
        unit: "mm",
        place: "gripper distance",
        find: |m| m.gripper_distance_mm.as_ref(),
        limit: |l| Some(l.gripper_distance * 1e3),
    },
    Measure {
        key: "workspace_mm",
        label: "outside workspace",
        unit: "mm",
        place: "outside workspace",
        find: |m| m.workspace_mm.as_ref(),
        limit: |l| l.workspace.map(|_| 0.0),
    },
];
