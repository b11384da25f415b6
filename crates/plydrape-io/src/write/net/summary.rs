//! A net in a few numbers, judged: what `plydrape net` prints as a table or as JSON.

use super::Findings;
use crate::store::shown::millimeters;
use plydrape::net::{
    Boundary, EdgeRule, Generators, Missing, Net, PlyPoint, Reason, Seeds, SharpEdges, Trim,
};
use serde::Serialize;
use std::fmt::Write;

/// Fabric no farther than this beyond the boundary of the mold, in mesh widths, lies on it: rounding.
const HAIR: f64 = 1e-6;

/// A net in a few numbers, judged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// All of the ply has a place, and no cell shears more than allowed.
    pub accepted: bool,
    /// Nodes along u and v.
    pub nodes: [usize; 2],
    /// Mesh widths along u and v (m).
    pub mesh: [f64; 2],
    /// How the generators run.
    pub generators: Generators,
    /// How the fabric between neighboring nodes is measured.
    pub edges: EdgeRule,
    /// The node that is placed first.
    pub seed: [usize; 2],
    /// Where it lies (m).
    pub seed_place: [f64; 3],
    /// Largest magnitude of a cell's shear (°); `None` without whole cells.
    pub max_shear_deg: Option<f64>,
    /// Where that is.
    pub max_shear_at: Option<ShearPlace>,
    /// Mean magnitude of the cells' shear (°).
    pub mean_shear_deg: f64,
    /// Largest shear allowed (°): the scene's limit or the material's locking angle, if there is one.
    pub shear_limit_deg: Option<f64>,
    /// Largest error of an edge's length (m).
    pub max_edge_error: f64,
    /// Nodes of the ply with a place on the mold.
    pub placed: usize,
    /// Nodes beyond the mold's boundary.
    pub off_mold: usize,
    /// Nodes where the ply folds.
    pub folded: usize,
    /// Nodes behind a fold.
    pub unreached: usize,
    /// Of each reason that occurs, the missing node closest to the seed.
    pub first_missing: Vec<Missing>,
    /// The ply's boundary on the mold; `None` for a strip without width.
    pub boundary: Option<BoundarySummary>,
    /// Sharp edges of the mold under the ply; `None` where the mold has no edges to tell.
    pub sharp_edges: Option<SharpEdgesSummary>,
    /// How far the ply's boundary is from the target boundary (m); `None` without one.
    pub trim: Option<Trim>,
    /// How the seed was chosen; `None` where it was given.
    pub search: Option<SearchSummary>,
}

/// The boundary of a ply on its mold, in a few numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BoundarySummary {
    /// Length on the mold, holes included (m).
    pub length: f64,
    /// Length of fabric of the boundary beyond that of the mold (m).
    pub off_mold_length: f64,
    /// Area of the ply beyond the boundary of the mold (m²).
    pub off_mold_area: f64,
    /// How far beyond it reaches (m); 0 where it does not.
    pub farthest_beyond: f64,
    /// Which fabric that is, and where; `None` where there is none.
    pub farthest_at: Option<PlyPoint>,
    /// Length of fabric of the boundary where the ply folds (m).
    pub folded_length: f64,
    /// Area of the ply where it folds (m²).
    pub folded_area: f64,
}

/// Sharp edges of the mold under the ply.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SharpEdgesSummary {
    /// Their length (m).
    pub length: f64,
    /// The largest angle by which the mold turns across one (°); `None` without any.
    pub sharpest_deg: Option<f64>,
    /// Which fabric runs over that, and where.
    pub sharpest_at: Option<PlyPoint>,
}

/// How a seed was chosen.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SearchSummary {
    /// Seeds and headings that were tried.
    pub choices: usize,
    /// Fabric coordinates of the seed that was taken (m).
    pub seed: [f64; 2],
    /// Heading of u asked of the point that was to lie at the origin (°).
    pub heading_deg: f64,
    /// Largest shear with the choice that was taken (°).
    pub max_shear_deg: Option<f64>,
    /// Largest shear from the point itself that was to lie at the origin (°), with the same heading.
    pub held_max_shear_deg: Option<f64>,
    /// How far that point is from the origin (m); `None` where it has no place.
    pub off: Option<f64>,
}

/// The middle of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ShearPlace {
    /// Lowest node.
    pub cell: [usize; 2],
    /// Fabric coordinates (m).
    pub u: f64,
    /// Fabric coordinates (m).
    pub v: f64,
    /// Mean of its nodes (m).
    pub place: [f64; 3],
}

impl Summary {
    /// A net and what is found of it in a few numbers, with the largest shear allowed (rad), if there is a limit.
    #[must_use]
    pub fn new(net: &Net, findings: &Findings, shear_limit: Option<f64>) -> Self {
        // accepted: all of the ply lies on the mold, and no cell shears beyond the limit
        let (placement, report) = (&net.placement, &net.report);
        let boundary = findings.boundary.as_ref().map(BoundarySummary::new);
        let hair = HAIR * placement.mesh[0].min(placement.mesh[1]);
        let lies = boundary.as_ref().is_none_or(|boundary| boundary.lies_on_mold(hair));
        let all = net.missing.is_empty() && lies;
        let within = match (report.largest_shear, shear_limit) {
            (Some((largest, _)), Some(limit)) => largest <= limit,
            _ => true,
        };
        Summary {
            accepted: all && within,
            // how the net was laid, and its shear
            nodes: placement.nodes,
            mesh: placement.mesh,
            generators: placement.generators,
            edges: placement.edges,
            seed: placement.seed,
            seed_place: placement.place,
            max_shear_deg: report.largest_shear.map(|(largest, _)| largest.to_degrees()),
            max_shear_at: report.largest_shear.and_then(|(_, cell)| ShearPlace::new(net, cell)),
            mean_shear_deg: report.mean_shear.to_degrees(),
            shear_limit_deg: shear_limit.map(f64::to_degrees),
            max_edge_error: report.largest_edge_error,
            // nodes with and without a place on the mold
            placed: report.placed,
            off_mold: report.off_mold,
            folded: report.folded,
            unreached: report.unreached,
            first_missing: report.first.clone(),
            boundary,
            sharp_edges: findings.sharp_edges.as_ref().map(SharpEdgesSummary::new),
            trim: findings.trim,
            search: findings.seeds.as_ref().map(SearchSummary::new),
        }
    }

    /// The table for people: one line a number, and a verdict at the end.
    #[must_use]
    pub fn table(&self) -> String {
        // how the net was made
        let ([nu, nv], [du, dv], [i, j]) = (self.nodes, self.mesh, self.seed);
        let generators = match self.generators {
            Generators::Geodesic => "straight over the mold",
            Generators::LeastShear => "with the least shear",
        };
        let edges = match self.edges {
            EdgeRule::Along => "along the mold",
            EdgeRule::Chord => "as straight bars",
        };
        let mut text = String::new();
        let mut add = |label: &str, entry: String| _ = writeln!(text, "{label:<14} {entry}");
        add("nodes", format!("{nu} × {nv}, {} on the mold", self.placed));
        add("mesh", format!("{} × {} mm, measured {edges}", millimeters(du), millimeters(dv)));
        let at = place_text(self.seed_place);
        add("generators", format!("{generators}, from node [{i}, {j}] at {at} mm"));

        // its shear, and how exactly its edges have their length
        match (self.max_shear_deg, &self.max_shear_at) {
            (Some(largest), Some(ShearPlace { u, v, place, .. })) => {
                let (u, v, at) = (millimeters(*u), millimeters(*v), place_text(*place));
                let worst = format!("{largest:.2}° at u = {u} mm, v = {v} mm, which is {at} mm");
                add("largest shear", worst);
                add("mean shear", format!("{:.2}°", self.mean_shear_deg));
            }
            _ => add("shear", "none: the net has no whole cell".into()),
        }
        add("edge error", format!("{:.1e} mm at most", self.max_edge_error * 1e3));

        // nodes without a place on the mold, with the first of each reason
        let missing = [
            ("off the mold", self.off_mold, Reason::OffMold),
            ("folded", self.folded, Reason::Folded),
            ("behind folds", self.unreached, Reason::Unreached),
        ];
        for (label, count, reason) in missing {
            let first = self.first_missing.iter().find(|m| m.reason == reason);
            add(label, first.map_or("no node".into(), |first| missing_text(count, first)));
        }
        self.lines_of_ply(&mut add);
        text + &format!("\n{}\n", self.verdict())
    }

    /// Adds the lines of the table on the boundary of the ply, sharp edges, trim and the search for the seed.
    fn lines_of_ply(&self, add: &mut dyn FnMut(&str, String)) {
        let of_ply = |at: &PlyPoint| {
            let [u, v] = at.fabric.map(tenths);
            format!("u = {u}, v = {v} mm")
        };

        // which part of the boundary lies on the mold, hangs over its edge or has no place
        if let Some(boundary) = &self.boundary {
            add("boundary", format!("{} mm on the mold", tenths(boundary.length)));
            if let Some(at) = &boundary.farthest_at {
                let [length, beyond] =
                    [boundary.off_mold_length, boundary.farthest_beyond].map(tenths);
                let (area, at) = (square_millimeters(boundary.off_mold_area), of_ply(at));
                let far = format!("up to {beyond} mm beyond at {at}");
                add("hangs over", format!("{length} mm of boundary, {area} mm²; {far}"));
            }
            if boundary.folded_length > 0.0 || boundary.folded_area > 0.0 {
                let length = tenths(boundary.folded_length);
                let area = square_millimeters(boundary.folded_area);
                add("no place", format!("{length} mm of boundary, {area} mm²: the ply folds"));
            }
        }

        // sharp edges of the mold that the ply lies over
        if let Some(edges) = &self.sharp_edges {
            let found = match (edges.sharpest_deg, &edges.sharpest_at) {
                (Some(angle), Some(at)) => {
                    let (length, at) = (tenths(edges.length), of_ply(at));
                    format!("{length} mm under the ply, up to {angle:.0}° at {at}")
                }
                _ => "none under the ply".into(),
            };
            add("sharp edges", found);
        }

        // how far the boundary is from the target boundary, to both sides
        if let Some(trim) = &self.trim {
            let most = |place: &Option<plydrape::net::TrimPlace>, side: &str| match place {
                Some(place) => {
                    let (error, at) = (millimeters(place.error.abs()), of_ply(&place.at));
                    format!("{error} mm {side} at most, at {at}")
                }
                None => format!("nowhere {side}"),
            };
            add("trim", most(&trim.beyond, "beyond"));
            add("", most(&trim.short, "short"));
            let (mean, compared) = (millimeters(trim.mean), tenths(trim.compared));
            add("", format!("{mean} mm on the mean of {compared} mm"));
            let (place, far) = trim.farthest_wanted;
            let (far, at) = (millimeters(far), place_text(place));
            add("", format!("{far} mm from the target boundary at most, at {at} mm"));
            if trim.not_compared > 0.0 {
                let rest = tenths(trim.not_compared);
                add("", format!("{rest} mm of boundary not compared: off the mold"));
            }
        }

        // the seed that the search found, and what a seed in the middle would have given
        if let Some(search) = &self.search {
            let [u, v] = search.seed.map(tenths);
            let shear = |shear: f64| format!("{shear:.2}°");
            let from_middle =
                search.held_max_shear_deg.filter(|held| Some(*held) != search.max_shear_deg);
            let found = search.max_shear_deg.map_or("no whole cell".into(), shear);
            let held = from_middle
                .map_or(String::new(), |held| format!(" against {} from the middle", shear(held)));
            let SearchSummary { heading_deg, choices, .. } = search;
            let seed = format!("seed u = {u}, v = {v} mm, heading {heading_deg:.2}°");
            add("search", format!("{seed}, best of {choices}: {found}{held}"));
        }
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
        if self.folded == 0 && self.off_mold == 0 {
            faults.extend(self.boundary.as_ref().and_then(BoundarySummary::fault));
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
    fn new(net: &Net, [i, j]: [usize; 2]) -> Option<Self> {
        let low = net.placement.fabric([i, j]);
        let [u, v] = [0, 1].map(|c| low[c] + 0.5 * net.placement.mesh[c]);
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

impl BoundarySummary {
    fn new(boundary: &Boundary) -> Self {
        BoundarySummary {
            length: boundary.length,
            off_mold_length: boundary.off_mold.length,
            off_mold_area: boundary.off_mold.area,
            farthest_beyond: boundary.farthest.map_or(0.0, |far| far.beyond),
            farthest_at: boundary.farthest.map(|far| far.at),
            folded_length: boundary.folded.length,
            folded_area: boundary.folded.area,
        }
    }

    /// Whether all of the ply lies on the mold, but for a hair (m).
    fn lies_on_mold(&self, hair: f64) -> bool {
        self.farthest_beyond <= hair && self.folded_length == 0.0 && self.folded_area == 0.0
    }

    /// What of a ply without missing nodes does not lie on the mold; `None` if all does.
    fn fault(&self) -> Option<String> {
        if self.folded_length > 0.0 || self.folded_area > 0.0 {
            return Some("the ply folds".into());
        }
        (self.farthest_beyond > 0.0).then(|| {
            format!(
                "the ply reaches {} mm beyond the mold's boundary",
                millimeters(self.farthest_beyond)
            )
        })
    }
}

impl SharpEdgesSummary {
    fn new(edges: &SharpEdges) -> Self {
        SharpEdgesSummary {
            length: edges.length,
            sharpest_deg: edges.sharpest.map(|(turn, _)| turn.to_degrees()),
            sharpest_at: edges.sharpest.map(|(_, at)| at),
        }
    }
}

impl SearchSummary {
    fn new(seeds: &Seeds) -> Self {
        let taken = &seeds.choices[seeds.chosen];
        // only the held point is in its place to the last bit
        let held = seeds.choices.iter().find(|choice| {
            choice.off == Some((0.0, 0.0)) && choice.held_heading == taken.held_heading
        });
        let degrees = |shear: Option<f64>| shear.map(f64::to_degrees);
        SearchSummary {
            choices: seeds.choices.len(),
            seed: taken.at.fabric,
            heading_deg: taken.held_heading.to_degrees(),
            max_shear_deg: degrees(taken.largest_shear_fine),
            held_max_shear_deg: degrees(held.and_then(|choice| choice.largest_shear_fine)),
            off: taken.off.map(|(off, _)| off),
        }
    }
}

/// How many nodes are missing, and the one next to the seed.
fn missing_text(count: usize, first: &Missing) -> String {
    let [i, j] = first.node;
    let text = format!("{count} nodes; next to the seed [{i}, {j}]");
    match (first.beyond, first.near) {
        (Some(beyond), _) => format!("{text}, {:.1} mm beyond the boundary", beyond * 1e3),
        (None, Some(near)) => format!("{text} at {} mm", place_text(near)),
        (None, None) => text,
    }
}

/// Millimeters, to a tenth.
fn tenths(meters: f64) -> String {
    format!("{}", (meters * 1e4).round() / 10.0 + 0.0)
}

/// Square millimeters, whole ones.
fn square_millimeters(area: f64) -> String {
    format!("{:.0}", area * 1e6)
}

/// A place in millimeters, to a tenth.
fn place_text(place: [f64; 3]) -> String {
    let [x, y, z] = place.map(|c| (c * 1e4).round() / 10.0 + 0.0);
    format!("({x}, {y}, {z})")
}
