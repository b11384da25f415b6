//! Cells that the boundary of a ply cuts, as they are drawn.

use super::SheetMesh;
use plydrape::layup::Settings;
use plydrape::ply::Ply;
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
    /// The cut cells of a sheet, in order; empty if the ply ends at lines of nodes, or the file is of another scene.
    pub fn all(ply: &Ply, settings: &Settings, mesh: &SheetMesh) -> Vec<CutCell> {
        let Some(cut) = &ply.cut else { return Vec::new() };
        let Ok(fabric) = Fabric::new(ply, settings) else { return Vec::new() };
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// Whole cells and what is drawn of those that the boundary cuts cover the ply once, a hole within one cell included; only
    /// slivers that the sheet leaves out are missing.
    #[test]
    fn what_is_drawn_is_the_ply() {
        let text = "[ply]\noutline = [[0, 0], [0.33, 0], [0.33, 0.15], [0.24, 0.23], [0, 0.23]]\n\
            holes = [{ middle = [0.15, 0.12], diameter = 0.05 }, { middle = [0.0657, 0.0657], diameter = 0.004 }]\n\
            grippers = [3, 2]\ncell = [0.12, 0.12]\narray = { partly = \"leave-off\" }\nmaterial = \"krogh2018\"\n\
            [grippers]\nspacing = [0.118, 0.118]\nheight = 0.05\n";
        let scene = crate::scene::parse(text, Path::new(""), "scene").unwrap().scene;
        let fabric = Fabric::new(&scene.layup.ply, &scene.layup.settings).unwrap();
        let mesh = SheetMesh {
            places: fabric.places.clone().into(),
            areas: fabric.areas.clone().into(),
            segments: Vec::new().into(),
            cells: fabric
                .cells
                .iter()
                .filter(|cell| cell.is_ply())
                .map(|cell| cell.nodes)
                .collect(),
            grippers: scene.layup.ply.grippers(),
            releases: false,
        };
        let cut = CutCell::all(&scene.layup.ply, &scene.layup.settings, &mesh);
        assert!(cut.iter().any(|cell| cell.rings.len() == 2), "a cell with a hole in it");
        let size = |nodes: [u32; 4]| {
            let [low, high] = [nodes[0], nodes[2]].map(|n| fabric.places[n as usize]);
            (high[0] - low[0]) * (high[1] - low[1])
        };
        let share = |points: &[[f64; 2]]| {
            let next = points.iter().cycle().skip(1);
            0.5 * points.iter().zip(next).map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum::<f64>()
        };
        let whole = fabric.cells.iter().map(|cell| cell.nodes);
        let whole = whole.filter(|nodes| cut.iter().all(|other| other.nodes != *nodes));
        let whole: f64 = whole.map(size).sum();
        let part = |cell: &CutCell| cell.rings.iter().map(|ring| share(ring)).sum::<f64>();
        let parts: f64 = cut.iter().map(|cell| part(cell) * size(cell.nodes)).sum();
        let area = scene.layup.ply.cut.as_ref().unwrap().outline.area();
        assert!((1.0 - (whole + parts) / area).abs() < 2e-3, "{whole} + {parts} of {area} m²");
        for cell in &cut {
            let own = mesh.cells[cell.cell];
            assert!(own.iter().any(|node| cell.nodes.contains(node)), "values of a cell beside it");
        }
    }
}
