//! Directions in which the circumstances of a ply change, along which its solved state is differentiated.

use crate::material::{Material, Section};
use crate::ply::{self, Ply};

/// A direction in which a ply's circumstances change; relative changes are for lines along u, lines along v
/// and diagonals.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// Velocity of each gripper (m), in the order of [`crate::ply::Ply::index`].
    pub grippers: Vec<[f64; 3]>,
    /// Relative change of fabric lengths.
    pub length: [f64; 3],
    /// Relative change of the weight.
    pub weight: [f64; 3],
    /// Relative change of the flexural rigidity.
    pub rigidity: [f64; 3],
}

/// A number of a material that a ply's shape depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Property {
    /// Mass per length (kg/m), or per area (kg/m²).
    Mass,
    /// Flexural rigidity EI (N·m²) of a material by line.
    FlexuralRigidity,
    /// Bending rigidity per width along the warp (N·m) of a material by area.
    WarpRigidity,
    /// Bending rigidity per width along the weft (N·m) of a material by area.
    WeftRigidity,
}

impl Property {
    /// The properties of a material.
    #[must_use]
    pub fn of_material(material: &Material) -> &'static [Property] {
        match material.section {
            Section::Line { .. } => &[Property::Mass, Property::FlexuralRigidity],
            Section::Areal { .. } => {
                &[Property::Mass, Property::WarpRigidity, Property::WeftRigidity]
            }
        }
    }

    /// Key in a scene file.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Property::Mass => "mass",
            Property::FlexuralRigidity => "flexural_rigidity",
            Property::WarpRigidity => "bending_rigidity_warp",
            Property::WeftRigidity => "bending_rigidity_weft",
        }
    }
}

impl Direction {
    /// No change, for `grippers` grippers.
    #[must_use]
    pub fn none(grippers: usize) -> Direction {
        let none = [0.0; 3];
        Direction { grippers: vec![none; grippers], length: none, weight: none, rigidity: none }
    }

    /// One unit more of a property of the ply's material: derivatives along it are per that unit.
    ///
    /// None if the material does not have the property, or if it is zero: there a line changes its order, and
    /// its slopes have no derivative.
    #[must_use]
    pub fn property(ply: &Ply, property: Property) -> Option<Direction> {
        let mut direction = Direction::none(ply.grippers());
        let inverse = |value: f64| (value > 0.0).then(|| 1.0 / value);
        match (ply.material.section, property) {
            (Section::Line { mass, .. } | Section::Areal { mass, .. }, Property::Mass) => {
                direction.weight = [inverse(mass)?; 3];
            }
            (Section::Line { flexural_rigidity, .. }, Property::FlexuralRigidity) => {
                direction.rigidity = [inverse(flexural_rigidity)?; 3];
            }
            (
                Section::Areal { warp_rigidity, weft_rigidity, .. },
                Property::WarpRigidity | Property::WeftRigidity,
            ) => {
                let along_warp = property == Property::WarpRigidity;
                let along_u = along_warp == (ply.warp == ply::Direction::U);
                let own = if along_warp { warp_rigidity } else { weft_rigidity };
                direction.rigidity[usize::from(!along_u)] = inverse(own)?;
                // a diagonal has the mean of both
                direction.rigidity[2] = inverse(warp_rigidity + weft_rigidity)?;
            }
            _ => return None,
        }
        Some(direction)
    }

    /// One meter more of fabric in every cell along u (0) or v (1): derivatives along it are per meter.
    ///
    /// A diagonal √(a²+b²) grows by a/√(a²+b²) with a. A line of a material by area stands for a strip that is
    /// one cell wide: it widens with the other side, and a diagonal with the mean of both.
    #[must_use]
    pub fn cell(ply: &Ply, along: usize) -> Direction {
        let mut direction = Direction::none(ply.grippers());
        let [a, b] = ply.cell;
        let side = ply.cell[along];
        direction.length[along] = 1.0 / side;
        direction.length[2] = side / (a * a + b * b);
        if let Section::Areal { .. } = ply.material.section {
            let mut wider = [0.0, 0.0, 1.0 / (a + b)];
            wider[1 - along] = 1.0 / side;
            (direction.weight, direction.rigidity) = (wider, wider);
        }
        direction
    }

    /// Meters of a gripper along an axis.
    #[must_use]
    pub fn gripper(ply: &Ply, gripper: usize, axis: usize) -> Direction {
        let mut direction = Direction::none(ply.grippers());
        direction.grippers[gripper][axis] = 1.0;
        direction
    }
}
