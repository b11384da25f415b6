//! The world of a verdict: how near to a real cell the one is in which it was reached.

use super::Scene;
use crate::layup::PadSettings;

/// In which world a drape was judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum World {
    /// Mounts are rigid, and nothing is off.
    #[default]
    Ideal,
    /// Mounts give, and nothing is off.
    #[cfg_attr(feature = "serde", serde(rename = "without errors"))]
    WithoutErrors,
    /// By a sample of cells with the errors of the scene.
    Errors,
}

impl World {
    /// The world of pads, judged with errors or without.
    #[must_use]
    pub fn new(pad: &PadSettings, with_errors: bool) -> Self {
        match (with_errors, pad.gives()) {
            (true, _) => World::Errors,
            (false, true) => World::WithoutErrors,
            (false, false) => World::Ideal,
        }
    }

    /// What follows the word accepted: ` in an ideal cell, without errors`, ` without errors`, or nothing.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            World::Ideal => " in an ideal cell, without errors",
            World::WithoutErrors => " without errors",
            World::Errors => "",
        }
    }
}

impl Scene {
    /// The world in which the scene is judged, unless its errors are left out.
    #[must_use]
    pub fn world(&self) -> World {
        let drawn = self.errors.is_some_and(|errors| errors.is_drawn());
        World::new(&self.layup.settings.pad, drawn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::errors::{Errors, Term};

    /// Errors of zero, or of no cells, are none; a mount that gives one way gives.
    #[test]
    fn a_world_is_ideal_only_where_mounts_are_rigid_and_nothing_is_off() {
        let layup = crate::errors::tests::layup(2, 2);
        let mut scene = Scene::new(layup.ply, layup.settings, layup.motion);
        assert_eq!(scene.world(), World::Ideal);
        let mut errors = Errors::default();
        scene.errors = Some(errors);
        assert_eq!(scene.world(), World::Ideal);
        errors.material.shear = Term::Factor(2.0);
        scene.errors = Some(errors);
        assert_eq!(scene.world(), World::Errors);
        scene.errors = Some(Errors { samples: 0, ..errors });
        scene.layup.settings.pad.axial_stiffness = Some(2e3);
        assert_eq!(scene.world(), World::WithoutErrors);
    }
}
