//! An array of grippers, and the names of the catenaries between them.

use super::GripperId;

/// An array of `nu × nv` grippers; `nv = 1` is a single strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Grid {
    /// Grippers along u, at least 2; 0 of [`Grid::NONE`].
    pub nu: usize,
    /// Grippers along v, at least 1; 0 of [`Grid::NONE`].
    pub nv: usize,
}

/// The four families of catenaries.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Kind {
    /// Fiber line along u: in a whole array from `[i, j]` to `[i+1, j]`.
    EdgeU,
    /// Fiber line along v: from `[i, j]` to `[i, j+1]`.
    EdgeV,
    /// Bias line that goes on along u and along v: from `[i, j]` to `[i+1, j+1]`.
    Rising,
    /// Bias line that goes back along u and on along v: from `[i+1, j]` to `[i, j+1]`.
    Falling,
}

/// One catenary: its family and the grippers at its two ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Catenary {
    /// Which family.
    pub kind: Kind,
    /// First end.
    pub from: GripperId,
    /// Second end.
    pub to: GripperId,
}

impl Kind {
    /// True for fiber lines, false for bias lines.
    #[must_use]
    pub fn is_edge(self) -> bool {
        matches!(self, Kind::EdgeU | Kind::EdgeV)
    }
}

impl Grid {
    /// No whole array along the yarns.
    pub const NONE: Grid = Grid { nu: 0, nv: 0 };

    /// Number of grippers.
    #[must_use]
    pub fn grippers(self) -> usize {
        self.nu * self.nv
    }

    /// Position of a gripper in all per-gripper arrays: i runs fastest.
    #[must_use]
    pub fn index(self, [i, j]: GripperId) -> usize {
        j * self.nu + i
    }

    /// The gripper at a position of the per-gripper arrays.
    #[must_use]
    pub fn id(self, index: usize) -> GripperId {
        [index % self.nu, index / self.nu]
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(self) -> usize {
        self.nu.saturating_sub(1) * self.nv.saturating_sub(1)
    }
}
