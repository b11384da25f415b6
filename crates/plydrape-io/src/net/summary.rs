//! A net in a few numbers, judged: what `plydrape net` prints as a table or as JSON.

use plydrape::net::{EdgeRule, Generators, Missing, Net, Reason};
use serde::Serialize;
use std::fmt::Write;

/// A net in a few numbers, judged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Every node has a place, and no cell shears more than allowed.
    pub accepted: bool,
    /// Nodes along u and v.
    pub nodes: [usize; 2],
    /// Mesh widths along u and v (m).
    pub mesh: [f64; 2],
    /// How the generators run.
    pub generators: Generators,
    /// How the fabric between neighbouring nodes is measured.
    pub edges: EdgeRule,
    /// The node that is placed first.
    pub seed: [usize; 2],
    /// Where it lies (m).
    pub seed_place: [f64; 3],
    /// Largest magnitude of a cell's shear (°); none without whole cells.
    pub max_shear_deg: Option<f64>,
    /// Where that is.
    pub max_shear_at: Option<ShearPlace>,
    /// Mean magnitude of the cells' shear (°).
    pub mean_shear_deg: f64,
    /// Largest shear allowed (°): the scene's limit or the material's locking angle, if there is one.
    pub shear_limit_deg: Option<f64>,
    /// Largest error of an edge's length (m).
    pub max_edge_error: f64,
    /// Nodes with a place on the mold.
    pub placed: usize,
    /// Nodes beyond the mold's boundary.
    pub off_mold: usize,
    /// Nodes where the ply folds.
    pub folded: usize,
    /// Nodes behind a fold.
    pub unreached: usize,
    /// Of each reason that occurs, the missing node closest to the seed.
    pub first_missing: Vec<Missing>,
}

/// The middle of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ShearPlace {
    /// Its lowest node.
    pub cell: [usize; 2],
    /// Fabric coordinates (m).
    pub u: f64,
    /// Fabric coordinates (m).
    pub v: f64,
    /// Mean of its nodes (m).
    pub place: [f64; 3],
}

impl Summary {
    /// Of a net, with the largest shear allowed (rad), if there is a limit.
    #[must_use]
    pub fn of(net: &Net, shear_limit: Option<f64>) -> Self {
        let (layup, report) = (&net.layup, &net.report);
        let all = report.placed == net.nodes.len();
        let within = match (report.largest_shear, shear_limit) {
            (Some((largest, _)), Some(limit)) => largest <= limit,
            _ => true,
        };
        Summary {
            accepted: all && within,
            nodes: layup.nodes,
            mesh: layup.mesh,
            generators: layup.generators,
            edges: layup.edges,
            seed: layup.seed,
            seed_place: layup.place,
            max_shear_deg: report.largest_shear.map(|(largest, _)| largest.to_degrees()),
            max_shear_at: report.largest_shear.and_then(|(_, cell)| ShearPlace::of(net, cell)),
            mean_shear_deg: report.mean_shear.to_degrees(),
            shear_limit_deg: shear_limit.map(f64::to_degrees),
            max_edge_error: report.largest_edge_error,
            placed: report.placed,
            off_mold: report.off_mold,
            folded: report.folded,
            unreached: report.unreached,
            first_missing: report.first.clone(),
        }
    }

    /// The table for people: one line a number, and a verdict at the end.
    #[must_use]
    pub fn table(&self) -> String {
        let ([nu, nv], [du, dv], [i, j]) = (self.nodes, self.mesh, self.seed);
        let generators = match self.generators {
            Generators::Geodesic => "straight over the mold",
            Generators::LeastShear => "with the least shear",
        };
        let edges = match self.edges {
            EdgeRule::Along => "along the mold",
            EdgeRule::Chord => "as straight bars",
        };
        let mut lines = vec![
            ("nodes", format!("{nu} × {nv}, {} on the mold", self.placed)),
            ("mesh", format!("{} × {} mm, measured {edges}", mm(du), mm(dv))),
            (
                "generators",
                format!("{generators}, from node [{i}, {j}] at {} mm", at(self.seed_place)),
            ),
        ];
        match (self.max_shear_deg, &self.max_shear_at) {
            (Some(largest), Some(ShearPlace { u, v, place, .. })) => {
                let (u, v) = (mm(*u), mm(*v));
                lines.push((
                    "largest shear",
                    format!("{largest:.2}° at u = {u} mm, v = {v} mm, which is {} mm", at(*place)),
                ));
                lines.push(("mean shear", format!("{:.2}°", self.mean_shear_deg)));
            }
            _ => lines.push(("shear", "none: the net has no whole cell".into())),
        }
        lines.push(("edge error", format!("{:.1e} mm at most", self.max_edge_error * 1e3)));
        let missing = [
            ("off the mold", self.off_mold, Reason::OffMold),
            ("folded", self.folded, Reason::Folded),
            ("behind folds", self.unreached, Reason::Unreached),
        ];
        for (label, count, reason) in missing {
            let first = self.first_missing.iter().find(|m| m.reason == reason);
            lines.push((label, first.map_or("no node".into(), |first| missing_text(count, first))));
        }
        let mut text = String::new();
        for (label, entry) in lines {
            let _ = writeln!(text, "{label:<14} {entry}");
        }
        let _ = writeln!(text, "\n{}", self.verdict());
        text
    }

    /// One line: accepted, or not and why.
    #[must_use]
    pub fn verdict(&self) -> String {
        if self.accepted {
            return "accepted".into();
        }
        let mut faults = Vec::new();
        if self.folded > 0 {
            faults.push("the ply folds".to_owned());
        }
        if self.off_mold > 0 {
            faults.push(format!("{} of its nodes lie beyond the mold's boundary", self.off_mold));
        }
        match (self.max_shear_deg, self.shear_limit_deg) {
            (Some(largest), Some(limit)) if largest > limit => {
                faults.push(format!("shear {largest:.2}° against {limit:.2}°"));
            }
            _ => {}
        }
        format!("not accepted: {}", faults.join("; "))
    }
}

impl ShearPlace {
    fn of(net: &Net, [i, j]: [usize; 2]) -> Option<Self> {
        let [u, v] = [0, 1].map(|c| ([i, j][c] as f64 + 0.5) * net.layup.mesh[c]);
        let ring = [
            net.node([i, j])?,
            net.node([i + 1, j])?,
            net.node([i + 1, j + 1])?,
            net.node([i, j + 1])?,
        ];
        let place = [0, 1, 2].map(|c| ring.iter().map(|p| p[c]).sum::<f64>() / 4.0);
        Some(ShearPlace { cell: [i, j], u, v, place })
    }
}

/// How many nodes are missing, and the one next to the seed.
fn missing_text(count: usize, first: &Missing) -> String {
    let [i, j] = first.node;
    let text = format!("{count} nodes; next to the seed [{i}, {j}]");
    match (first.beyond, first.near) {
        (Some(beyond), _) => format!("{text}, {:.1} mm beyond the boundary", beyond * 1e3),
        (None, Some(near)) => format!("{text} at {} mm", at(near)),
        (None, None) => text,
    }
}

/// Millimetres, to a thousandth.
fn mm(metres: f64) -> String {
    format!("{}", (metres * 1e6).round() / 1e3 + 0.0)
}

/// A place in millimetres, to a tenth.
fn at(place: [f64; 3]) -> String {
    let [x, y, z] = place.map(|c| (c * 1e4).round() / 10.0 + 0.0);
    format!("({x}, {y}, {z})")
}
