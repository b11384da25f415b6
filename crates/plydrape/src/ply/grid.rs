//! Which catenaries hang between which grippers.

/// A gripper by its grid indices `[i, j]`, from `[0, 0]`: i along u, j along v.
pub type GripperId = [usize; 2];

/// An array of `nu × nv` grippers; `nv = 1` is a single strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
    /// Edge from `[i, j]` to `[i+1, j]`.
    EdgeU,
    /// Edge from `[i, j]` to `[i, j+1]`.
    EdgeV,
    /// Diagonal from `[i, j]` to `[i+1, j+1]`.
    Rising,
    /// Diagonal from `[i+1, j]` to `[i, j+1]`.
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
    /// True for the fibre directions, false for diagonals.
    #[must_use]
    pub fn is_edge(self) -> bool {
        matches!(self, Kind::EdgeU | Kind::EdgeV)
    }
}

impl Grid {
    /// No array along the yarns: no catenary hangs.
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

    /// Number of catenaries: edges along u, edges along v, then two diagonals per cell.
    #[must_use]
    pub fn catenaries(self) -> usize {
        self.edges() + 2 * self.cells()
    }

    /// Number of edge catenaries; they come first.
    #[must_use]
    pub fn edges(self) -> usize {
        self.edges_u() + self.nu * self.nv.saturating_sub(1)
    }

    /// Number of edges along u; they come first of all.
    #[must_use]
    pub fn edges_u(self) -> usize {
        self.nu.saturating_sub(1) * self.nv
    }

    /// Index of the edge from `[i, j]` to `[i+1, j]`.
    #[must_use]
    pub fn edge_u(self, [i, j]: GripperId) -> usize {
        j * (self.nu - 1) + i
    }

    /// Index of the edge from `[i, j]` to `[i, j+1]`.
    #[must_use]
    pub fn edge_v(self, [i, j]: GripperId) -> usize {
        self.edges_u() + j * self.nu + i
    }

    /// Indices of the rising and falling diagonal of the cell whose lowest corner is `[i, j]`.
    #[must_use]
    pub fn diagonals(self, [i, j]: GripperId) -> [usize; 2] {
        let first = self.edges() + 2 * (j * (self.nu - 1) + i);
        [first, first + 1]
    }

    /// The catenary with a given index.
    #[must_use]
    pub fn catenary(self, index: usize) -> Catenary {
        if index < self.edges_u() {
            let (i, j) = (index % (self.nu - 1), index / (self.nu - 1));
            return Catenary { kind: Kind::EdgeU, from: [i, j], to: [i + 1, j] };
        }
        if index < self.edges() {
            let k = index - self.edges_u();
            let (i, j) = (k % self.nu, k / self.nu);
            return Catenary { kind: Kind::EdgeV, from: [i, j], to: [i, j + 1] };
        }
        let k = index - self.edges();
        let (i, j) = (k / 2 % (self.nu - 1), k / 2 / (self.nu - 1));
        if k.is_multiple_of(2) {
            Catenary { kind: Kind::Rising, from: [i, j], to: [i + 1, j + 1] }
        } else {
            Catenary { kind: Kind::Falling, from: [i + 1, j], to: [i, j + 1] }
        }
    }
}
