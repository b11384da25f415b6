//! Which grippers are moved at once when a ply is differentiated.
//!
//! What a gripper does to the ply decays within a few cells, by a factor of 10 to 100 a cell. So grippers that are far
//! apart are moved together, and each element's change is put down to the one of them that is near: so many directions are
//! enough as a neighborhood has grippers, whatever the array's size (Curtis, Powell and Reid 1974).

use crate::ply::{Grid, GripperId, Ply};

/// Groups of grippers, each a stride apart along u and v.
#[derive(Debug, Clone, Copy)]
pub struct Coloring {
    grid: Grid,
    reach: usize,
}

impl Coloring {
    /// Groups for an influence of a gripper that ends `reach` cells away from it.
    fn new(grid: Grid, reach: usize) -> Self {
        Coloring { grid, reach }
    }

    /// Groups for a ply; where its cups are no whole array, each of them is a group of its own, because lines of several pitches
    /// carry an influence farther.
    pub fn from_ply(ply: &Ply, reach: usize) -> Self {
        let grid = ply.rows();
        Coloring::new(grid, if ply.grid == Grid::NONE { grid.grippers() } else { reach })
    }

    /// Grippers along u and v of which one each is in a group.
    fn strides(&self) -> [usize; 2] {
        [self.grid.nu, self.grid.nv].map(|count| count.min(2 * self.reach + 2))
    }

    /// Whether each group is a single gripper.
    pub fn is_whole(&self) -> bool {
        self.strides() == [self.grid.nu, self.grid.nv]
    }

    /// How many groups there are.
    pub fn groups(&self) -> usize {
        let [u, v] = self.strides();
        u * v
    }

    /// The grippers of a group.
    pub fn members(self, group: usize) -> impl Iterator<Item = usize> {
        let ([u, v], grid) = (self.strides(), self.grid);
        let rows = (group / u..grid.nv).step_by(v);
        rows.flat_map(move |j| (group % u..grid.nu).step_by(u).map(move |i| grid.index([i, j])))
    }

    /// The gripper of a group that is near a cell or line that begins at a gripper, and whether it is as far as that can
    /// be; `None` beyond the boundary.
    pub fn near(&self, group: usize, [i, j]: GripperId) -> Option<(usize, bool)> {
        let [u, v] = self.strides();
        let (i, far_u) = self.along(i, group % u, self.grid.nu)?;
        let (j, far_v) = self.along(j, group / u, self.grid.nv)?;
        debug_assert!(j % v == group / u);
        Some((self.grid.index([i, j]), far_u || far_v))
    }

    /// As [`Self::near`], along one direction with `count` grippers.
    fn along(&self, corner: usize, first: usize, count: usize) -> Option<(usize, bool)> {
        let stride = 2 * self.reach + 2;
        if count <= stride {
            return Some((first, false));
        }
        // between `reach` before the corner and `reach` behind the next gripper
        let ahead = (first + self.reach + stride - corner % stride) % stride;
        let near = (corner + ahead).checked_sub(self.reach).filter(|near| *near < count)?;
        Some((near, ahead == 0 || ahead + 1 == stride))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Every gripper is in one group; and every gripper within reach of a cell is the one of its group that is near it.
    #[test]
    fn every_gripper_within_reach_is_the_near_one_of_its_group() {
        for (nu, nv, reach) in [(5, 3, 2), (17, 11, 2), (30, 7, 3), (9, 40, 4)] {
            let grid = Grid { nu, nv };
            let coloring = Coloring::new(grid, reach);
            let all: Vec<usize> =
                (0..coloring.groups()).flat_map(|group| coloring.members(group)).collect();
            assert_eq!(all.len(), grid.grippers());
            assert_eq!(all.into_iter().collect::<BTreeSet<_>>().len(), grid.grippers());
            for corner in (0..grid.grippers()).map(|n| grid.id(n)) {
                let near: BTreeSet<usize> = (0..coloring.groups())
                    .filter_map(|group| {
                        let (gripper, _) = coloring.near(group, corner)?;
                        assert!(coloring.members(group).any(|member| member == gripper));
                        Some(gripper)
                    })
                    .collect();
                let within = |n: &usize| {
                    (0..2).all(|d| {
                        let at = grid.id(*n)[d];
                        at + reach >= corner[d] && at <= corner[d] + reach + 1
                    })
                };
                let expected: BTreeSet<usize> = (0..grid.grippers()).filter(within).collect();
                assert!(near.is_superset(&expected), "{nu} × {nv}, {corner:?}");
            }
        }
    }
}
