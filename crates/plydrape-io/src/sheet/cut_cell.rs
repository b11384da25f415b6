//! Cells that the boundary of a ply cuts, as they are drawn.

use super::SheetMesh;
use plydrape::ply::Ply;
use plydrape::scene::Settings;
use plydrape::sheet::Fabric;
use serde::Serialize;
use std::collections::HashMap;

/// A cell of which a part is ply.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct CutCell {
    /// Nodes at its corners, in order around it.
    pub nodes: [u32; 4],
    /// The cell of the file whose values it has: itself where half of it or more is ply, else one beside it.
    pub cell: usize,
    /// What of it is ply, as shares of its sides from its first corner: rings with the ply on their left.
    pub rings: Vec<Vec<[f64; 2]>>,
}

impl CutCell {
    /// Those of a sheet, in order; none of a ply that ends at lines of nodes, and none where the file is of another scene.
    pub fn all(ply: &Ply, settings: &Settings, mesh: &SheetMesh) -> Vec<CutCell> {
        let Some(cut) = &ply.cut else { return Vec::new() };
        let Ok(fabric) = Fabric::of(ply, settings) else { return Vec::new() };
        if fabric.places.len() != mesh.places.len() {
            return Vec::new();
        }
        let mut around: HashMap<u32, Vec<usize>> = HashMap::new();
        for (n, cell) in mesh.cells.iter().enumerate() {
            for node in cell {
                around.entry(*node).or_default().push(n);
            }
        }
        // the cell of the file with most of its corners
        let nearest = |nodes: [u32; 4]| {
            let beside = nodes.iter().filter_map(|node| around.get(node)).flatten();
            let shared =
                |n: usize| nodes.iter().filter(|node| mesh.cells[n].contains(node)).count();
            beside.copied().max_by_key(|n| (shared(*n), std::cmp::Reverse(*n)))
        };
        let cells = fabric.cells.iter().filter(|cell| cell.share < 1.0 - 1e-9);
        let drawn = cells.filter_map(|cell| {
            let [low, high] = [cell.nodes[0], cell.nodes[2]].map(|n| fabric.places[n as usize]);
            let share = |point: &[f64; 2]| [0, 1].map(|n| (point[n] - low[n]) / (high[n] - low[n]));
            let rings = cut.outline.rings_in(low, high);
            let rings = rings.iter().map(|ring| ring.iter().map(share).collect()).collect();
            Some(CutCell { nodes: cell.nodes, cell: nearest(cell.nodes)?, rings })
        });
        drawn.collect()
    }

    /// Its rings as one: holes inside of it are joined by a line there and back.
    pub fn polygon(&self) -> Vec<[f64; 2]> {
        let mut out: Vec<[f64; 2]> = Vec::new();
        for ring in &self.rings {
            out.extend(ring);
            out.extend(ring.first());
            if self.rings.len() > 1 {
                out.extend(out.first().copied());
            }
        }
        out
    }
}
