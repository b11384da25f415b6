//! How the net of the ideal drape begins: its seed, its mesh and its generators.
//!
//! Grippers hold nodes of the net. So every cell of the ply is divided into a whole number of meshes, and
//! into as many as put the seed on a node too.

use super::choice::{HeadingChoice, SeedChoice};
use super::file::{EdgesKey, GeneratorsKey, TargetTable};
use super::located::Located;
use super::quantity::{Quantity, Read, read_or, rounded};
use super::source::Document;
use super::usual;
use crate::Error;
use plydrape::mold::Mold;
use plydrape::net::{EdgeRule, Free, Generators, Placement};
use plydrape::ply::{Cut, Ply};
use std::ops::Range;

/// Widest mesh on a curved mold unless given, as a share of the shorter side of a cell.
pub(super) const MESH: f64 = 0.1;
/// Most nodes of a net.
const MOST_NODES: usize = 250_000;
/// Most meshes that a cell is divided into to put the seed on a node.
const MOST_DIVISIONS: usize = 1000;
/// A length divides another if the quotient is this close to a whole number.
const WHOLE: f64 = 1e-9;

/// Lengths of the fabric along u and along v (m): between the outermost grippers, or of all of a ply that is cut.
pub(super) fn extent(ply: &Ply) -> [f64; 2] {
    match &ply.cut {
        Some(cut) => {
            let [low, high] = cut.outline.bounds();
            [high[0] - low[0], high[1] - low[1]]
        }
        None => [(ply.grid.nu - 1) as f64 * ply.cell[0], (ply.grid.nv - 1) as f64 * ply.cell[1]],
    }
}

/// What `[target]` leaves to a search.
pub(super) fn free(keys: &TargetTable) -> Free {
    let seed = keys.seed.as_ref().is_some_and(|seed| matches!(seed.value, SeedChoice::Best));
    let best = |heading: &Located<HeadingChoice>| matches!(heading.value, HeadingChoice::Best);
    Free { seed, heading: keys.direction.as_ref().is_some_and(best) }
}

/// Checks the keys of `[target]` that say how the ply is laid on the mold; `table` is the place of the
/// whole table. What is to be searched for is the middle of the ply, and a heading of 0. Headings are given of the direction
/// from which u is turned by `turn` (rad).
pub(super) fn placement(
    keys: &TargetTable,
    table: &Range<usize>,
    ply: &Ply,
    turn: f64,
    mold: &Mold,
    document: &Document,
) -> Result<Placement, Error> {
    // what is searched for, and what is not given, is zero
    let shear = read_or(&keys.shear, 0.0, document)?;
    let heading = match &keys.direction {
        Some(Located { value: HeadingChoice::Angle(angle), span }) => {
            Located { value: angle.clone(), span: span.clone() }.read(document)?
        }
        Some(Located { value: HeadingChoice::Best, .. }) | None => 0.0,
    };
    let origin = read_or(&keys.origin, [0.0; 2], document)?;

    // the seed lies on the mold at the origin, as seen from above
    let Some(place) = mold.highest_point(origin) else {
        let [x, y] = origin.map(|c| format!("{} mm", round(c * 1e3)));
        return Err(document.error(
            keys.origin.as_ref().map_or(table.clone(), |origin| origin.span.clone()),
            format!("there is no mold at the origin of the target, x = {x}, y = {y}"),
            "give an `origin` that lies on the mold as seen from above: the seed is put there",
        ));
    };

    // nodes as the boundary of the ply or the array of grippers asks for
    let Nodes { nodes, mesh, origin, seed } = match &ply.cut {
        Some(cut) => nodes_of_cut(keys, ply, cut, mold, document)?,
        None => nodes_of_cells(keys, ply, mold, document)?,
    };

    Ok(Placement {
        nodes,
        mesh,
        origin,
        seed,
        place,
        heading: heading + turn,
        shear,
        generators: match keys.generators.as_ref().map(|key| key.value) {
            Some(GeneratorsKey::LeastShear) => Generators::LeastShear,
            Some(GeneratorsKey::Geodesic) | None => Generators::Geodesic,
        },
        edges: match keys.edges.as_ref().map(|key| key.value) {
            Some(EdgesKey::Chord) => EdgeRule::Chord,
            Some(EdgesKey::Along) | None => EdgeRule::Along,
        },
    })
}

/// The nodes of a net.
struct Nodes {
    /// Their number along u and v.
    nodes: [usize; 2],
    /// Mesh widths (m).
    mesh: [f64; 2],
    /// Fabric coordinates of the first (m).
    origin: [f64; 2],
    /// The seed.
    seed: [usize; 2],
}

/// Nodes of which grippers hold some.
fn nodes_of_cells(
    keys: &TargetTable,
    ply: &Ply,
    mold: &Mold,
    document: &Document,
) -> Result<Nodes, Error> {
    let seed = Seed::read(keys, ply, document)?;
    let divisions = match &keys.mesh {
        Some(width) => given_divisions(width, ply, &seed, document)?,
        None => own_divisions(ply, mold, &seed, document)?,
    };
    Ok(Nodes {
        nodes: nodes(ply, divisions),
        mesh: [0, 1].map(|n| ply.cell[n] / divisions[n] as f64),
        origin: [0.0; 2],
        seed: [0, 1].map(|n| (seed.cells[n] * divisions[n] as f64).round() as usize),
    })
}

/// Nodes that cover all of a ply that is cut, from its seed outwards; grippers hold what is between them.
fn nodes_of_cut(
    keys: &TargetTable,
    ply: &Ply,
    cut: &Cut,
    mold: &Mold,
    document: &Document,
) -> Result<Nodes, Error> {
    let [low, high] = cut.outline.bounds();
    let seed = match &keys.seed {
        None | Some(Located { value: SeedChoice::Middle | SeedChoice::Best, .. }) => ply.middle(),
        Some(Located { value: SeedChoice::At(point), span }) => {
            let uv = cut.fabric(point.read(document)?);
            if !(0..2).all(|n| (low[n]..=high[n]).contains(&uv[n])) {
                return Err(document.error(
                    span.clone(),
                    "the seed is no point of the ply",
                    "give a point [x, y] of the drawing on the ply; seed = \"middle\" is its middle",
                ));
            }
            uv
        }
    };
    let side = ply.cell[0].min(ply.cell[1]);
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let count = |mesh: f64| {
        [0, 1].map(|n| {
            // a rounding error beyond a node is none
            let steps = |length: f64| (length / mesh * (1.0 - WHOLE)).ceil().max(0.0) as usize;
            [steps(seed[n] - low[n]), steps(high[n] - seed[n])]
        })
    };
    let number = |mesh: f64| {
        let [[a, b], [c, d]] = count(mesh);
        (a + b + 1).saturating_mul(c + d + 1)
    };
    let mesh = match &keys.mesh {
        Some(width) => {
            let mesh = width.read(document)?;
            if size / mesh > MOST_NODES as f64 || number(mesh) > MOST_NODES {
                return Err(document.error(
                    width.span.clone(),
                    format!(
                        "{} makes a net of more than {MOST_NODES} nodes",
                        document.quoted(&width.span)
                    ),
                    format!("give a wider mesh; the ply is {} mm long", round(size * 1e3)),
                ));
            }
            mesh
        }
        None => {
            let mut mesh = if matches!(mold, Mold::Plane(_)) { side } else { MESH * side };
            while number(mesh) > MOST_NODES {
                mesh *= 1.25;
            }
            mesh
        }
    };
    let count = count(mesh);
    Ok(Nodes {
        nodes: count.map(|[before, after]| (before + after + 1).max(2)),
        mesh: [mesh; 2],
        origin: [0, 1].map(|n| seed[n] - count[n][0] as f64 * mesh),
        seed: count.map(|[before, _]| before),
    })
}

/// The fabric point that is laid first.
struct Seed {
    /// Where it lies in the fabric, in cells.
    cells: [f64; 2],
    /// Place in the scene, if it is given there.
    span: Option<Range<usize>>,
}

impl Seed {
    fn read(keys: &TargetTable, ply: &Ply, document: &Document) -> Result<Self, Error> {
        let most = [ply.grid.nu - 1, ply.grid.nv - 1].map(|count| count as f64);
        let Some(written) = &keys.seed else {
            return Ok(Seed { cells: [0.0; 2], span: None });
        };
        let span = Some(written.span.clone());
        let point = match &written.value {
            SeedChoice::Middle | SeedChoice::Best => {
                return Ok(Seed { cells: most.map(|count| 0.5 * count), span });
            }
            SeedChoice::At(point) => point.read(document)?,
        };
        let cells = [0, 1].map(|n| point[n] / ply.cell[n]);
        if (0..2).all(|n| cells[n] > -WHOLE && cells[n] < most[n] + WHOLE) {
            return Ok(Seed { cells, span });
        }
        let [u, v] = extent(ply).map(|length| round(length * 1e3));
        Err(document.error(
            written.span.clone(),
            "the seed is no point of the ply",
            format!("fabric points go from [0, 0] at gripper g0_0 to [\"{u} mm\", \"{v} mm\"] at the last one; seed = \"middle\" is halfway"),
        ))
    }

    /// Whether it lies on a node when every cell is divided into this many meshes.
    fn is_on_a_node(&self, n: usize, divisions: usize) -> bool {
        is_whole(self.cells[n] * divisions as f64)
    }
}

fn is_whole(value: f64) -> bool {
    (value - value.round()).abs() <= WHOLE * value.abs().max(1.0)
}

/// Nodes along u and v if every cell is divided into this many meshes.
fn nodes(ply: &Ply, divisions: [usize; 2]) -> [usize; 2] {
    [(ply.grid.nu - 1) * divisions[0] + 1, (ply.grid.nv - 1) * divisions[1] + 1]
}

fn is_too_fine(ply: &Ply, divisions: [usize; 2]) -> bool {
    let [nu, nv] = nodes(ply, divisions);
    nu.saturating_mul(nv) > MOST_NODES
}

/// The divisions of a mesh width that the scene gives.
fn given_divisions(
    width: &Quantity<usual::Mesh>,
    ply: &Ply,
    seed: &Seed,
    document: &Document,
) -> Result<[usize; 2], Error> {
    let value = width.read(document)?;
    let counts = [0, 1].map(|n| ply.cell[n] / value);
    // a strip has no cells along v to be divided
    let cells = [ply.grid.nu, ply.grid.nv].map(|grippers| grippers > 1);
    let fits = |n: usize, count: f64| !cells[n] || count >= 0.5 && is_whole(count);
    let error = |message: String, help: String| document.error(width.span.clone(), message, help);
    if !(0..2).all(|n| fits(n, counts[n])) {
        let [a, b] = ply.cell.map(|cell| round(cell * 1e3));
        let help = match nearest_width(value, ply, cells) {
            Some(nearest) => {
                format!("a width that does is \"{} mm\"", round(nearest * 1e3))
            }
            None => "leave `mesh` out: each side of a cell is then divided by itself".into(),
        };
        let sides =
            if cells[1] && a != b { format!("{a} mm and {b} mm") } else { format!("{a} mm") };
        return Err(error(
            format!("{} does not divide cells of {sides} evenly", document.quoted(&width.span)),
            help,
        ));
    }
    if (0..2).any(|n| cells[n] && counts[n] > MOST_NODES as f64)
        || is_too_fine(ply, counts.map(|count| count.round() as usize))
    {
        return Err(error(
            format!("{} makes a net of more than {MOST_NODES} nodes", document.quoted(&width.span)),
            format!("give a wider mesh; a cell is {} mm", round(ply.cell[0] * 1e3)),
        ));
    }
    let divisions = counts.map(|count| count.round().max(1.0) as usize);
    for n in 0..2 {
        if !seed.is_on_a_node(n, divisions[n]) {
            let axis = ["u", "v"][n];
            let node = (seed.cells[n] * divisions[n] as f64).round();
            let nearest = round(node * ply.cell[n] / divisions[n] as f64 * 1e3);
            return Err(document.error(
                seed.span.clone().unwrap_or(width.span.clone()),
                format!("the seed lies between nodes of the net along {axis}"),
                format!("move it to the node at {axis} = \"{nearest} mm\", or give another `mesh`"),
            ));
        }
    }
    Ok(divisions)
}

/// The width nearest to `value` that divides both cells evenly and can be written with few digits, if
/// there is one not far from it (m).
fn nearest_width(value: f64, ply: &Ply, cells: [bool; 2]) -> Option<f64> {
    let [a, b] = ply.cell;
    let wished = (a / value).round().clamp(1.0, 1e6) as usize;
    let width = |count: usize| a / count as f64;
    let fits = |count: usize| {
        let written = round(width(count) * 1e3).parse::<f64>().map_or(f64::NAN, |mm| mm * 1e-3);
        let counts = [a / written, b / written];
        is_whole(counts[0]) && (!cells[1] || counts[1] >= 0.5 && is_whole(counts[1]))
    };
    let counts = wished.saturating_sub(200).max(1)..=wished + 200;
    counts
        .filter(|count| fits(*count))
        .map(width)
        .min_by(|p, q| (p - value).abs().total_cmp(&(q - value).abs()))
}

/// The coarsest divisions with meshes of a tenth of a cell or less and the seed on a node; a plane needs none.
fn own_divisions(
    ply: &Ply,
    mold: &Mold,
    seed: &Seed,
    document: &Document,
) -> Result<[usize; 2], Error> {
    let mut divisions = [1; 2];
    let mut widest = if matches!(mold, Mold::Plane(_)) {
        f64::INFINITY
    } else {
        MESH * ply.cell[0].min(ply.cell[1])
    };
    loop {
        for n in 0..2 {
            let least = (ply.cell[n] / widest * (1.0 - WHOLE)).ceil().max(1.0) as usize;
            let found =
                (least..=least.max(MOST_DIVISIONS)).find(|count| seed.is_on_a_node(n, *count));
            divisions[n] = found.ok_or_else(|| off_nodes(n, seed, ply, document))?;
        }
        if !is_too_fine(ply, divisions) {
            return Ok(divisions);
        }
        // as coarse as the array allows, or as the seed does
        if divisions == [1; 2] {
            return Ok(divisions);
        }
        if widest > 2.0 * ply.cell[0].max(ply.cell[1]) {
            return Err(off_nodes(usize::from(divisions[0] == 1), seed, ply, document));
        }
        widest *= 1.25;
    }
}

/// The seed lies at no share of a cell that a net could have a node at.
fn off_nodes(n: usize, seed: &Seed, ply: &Ply, document: &Document) -> Error {
    let axis = ["u", "v"][n];
    let cell = round(ply.cell[n] * 1e3);
    document.error(
        seed.span.clone().unwrap_or(0..0),
        format!("no net of up to {MOST_NODES} nodes has one at the seed: it divides the cell along {axis} too oddly"),
        format!("put the seed on a simple share of a cell of {cell} mm, such as a half or a tenth"),
    )
}

/// A number for a message, without digits that say nothing.
pub(super) fn round(value: f64) -> String {
    let short = (value * 1e4).round() / 1e4;
    if short == 0.0 && value != 0.0 { rounded(value) } else { format!("{}", short + 0.0) }
}
