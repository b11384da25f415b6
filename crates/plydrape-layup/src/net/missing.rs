//! Nodes that have no place on the mold, and why.

use std::fmt;

/// Why a node has no place on the mold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Reason {
    /// It lies beyond the mold's boundary.
    OffMold,
    /// The two edges of the node have no common end on the mold, or only with a cell shut or turned over; beyond the
    /// boundary that counts as [`Reason::OffMold`].
    Folded,
    /// It depends on a node that folded.
    Unreached,
}

/// A node without a place.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Missing {
    /// Which node.
    pub node: [usize; 2],
    /// Why.
    pub reason: Reason,
    /// The last trial for its place (m); `None` where there was no trial.
    pub near: Option<[f64; 3]>,
    /// How far beyond the mold's boundary it lies (m); `None` where there was no trial.
    pub beyond: Option<f64>,
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [i, j] = self.node;
        match self.reason {
            Reason::OffMold => {
                let far = self.beyond.map(|beyond| format!("{:.2} mm ", 1e3 * beyond));
                let far = far.unwrap_or_default();
                write!(f, "node [{i}, {j}] lies {far}beyond the boundary of the mold")?;
            }
            Reason::Folded => write!(f, "the cell before node [{i}, {j}] shuts: the ply folds")?,
            Reason::Unreached => write!(f, "node [{i}, {j}] lies behind a fold")?,
        }
        match self.near {
            Some([x, y, z]) => write!(f, ", at ({x:.4}, {y:.4}, {z:.4}) m"),
            None => Ok(()),
        }
    }
}
