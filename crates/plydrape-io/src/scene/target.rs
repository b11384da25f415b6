//! Where the ply shall end: the ideal drape on the mold, or positions as given.

use super::file::TargetTable;
use super::located::Located;
use super::mold::usual_width;
use super::placement::{free, placement, round};
use super::places::{Places, X, Y, Z, csv_file, point};
use super::source::Document;
use super::table::Table;
use crate::Error;
use plydrape::LayupError;
use plydrape::layup::{ContactSettings, Target};
use plydrape::mold::mesh::DetailKind;
use plydrape::mold::{Mesh, Mold};
use plydrape::net::{Free, Missing, Net, Reason, Seeds, TargetBoundary};
use plydrape::ply::{Ply, gripper_name};
use std::sync::Arc;

/// Widest detail that is named where the ply folds, in widths that it spans unless given.
const FOLDING: f64 = 2.5;

/// Checks the table `[target]`; its heading is given of the direction from which u is turned by `turn` (rad).
pub(super) fn target(
    table: &Located<TargetTable>,
    ply: &Ply,
    turn: f64,
    mold: Option<&Mold>,
    document: &Document,
) -> Result<Target, Error> {
    let keys = &table.value;
    if let Some(positions) = &keys.positions {
        if let Some(key) = laying_key(keys) {
            return Err(document.error(
                positions.span.clone(),
                format!("the target has `positions` and `{key}`"),
                format!(
                    "keep `positions`, which say all, or `{key}` to have the ply laid on the mold"
                ),
            ));
        }
        let places = Places::read(positions, ply, document)?;
        places.check_run(ply, "at the target")?;
        return Ok(Target { grippers: places.points, drape: None });
    }
    let Some(mold) = mold else {
        return Err(document.error(
            table.span.clone(),
            "the target is a drape on a mold, and the scene has no mold",
            "add [mold] with kind = \"plane\", or give the target's `positions`",
        ));
    };
    let Laid { net, .. } = net(table, ply, turn, mold, document)?;
    // nodes that hang straight above each other have no span between them
    let places = Places {
        points: at_grippers(&net, ply, mold, table, document)?,
        document: document.clone(),
        spans: vec![header(table, document)],
        height: None,
    };
    places.check_run(ply, "at the target")?;
    Ok(Target { grippers: places.points, drape: Some(Arc::new(net)) })
}

/// A ply on its mold.
pub(super) struct Laid {
    /// The ideal drape.
    pub net: Net,
    /// How its seed and heading were chosen, if they were searched for.
    pub seeds: Option<Seeds>,
    /// The target boundary.
    pub wanted: Option<TargetBoundary>,
}

/// Lays the ply on the mold, as [`target`] reads its heading; nodes without a place are no fault here.
pub(super) fn net(
    table: &Located<TargetTable>,
    ply: &Ply,
    turn: f64,
    mold: &Mold,
    document: &Document,
) -> Result<Laid, Error> {
    let keys = &table.value;
    let placement = placement(keys, &table.span, ply, turn, mold, document)?;
    let outline = ply.cut.as_ref().map(|cut| &cut.outline);
    let mesh = placement.mesh[0].min(placement.mesh[1]);
    let wanted = match &keys.trim {
        Some(file) => Some(wanted(file, mold, mesh, document)?),
        None => None,
    };
    let no_net = |error: LayupError| no_net(keys, table, &error, document);
    let free = free(keys);
    let seeds = match free {
        Free { seed: false, heading: false } => None,
        _ => Some(Seeds::search(mold, placement, outline, free).map_err(no_net)?),
    };
    let placement = seeds.as_ref().map_or(placement, |seeds| seeds.placement);
    let net = Net::drape_cut(mold, placement, outline.cloned()).map_err(no_net)?;
    Ok(Laid { net, seeds, wanted })
}

/// The target boundary from a CSV file.
fn wanted(
    file: &Located<String>,
    mold: &Mold,
    mesh: f64,
    scene: &Document,
) -> Result<TargetBoundary, Error> {
    let document = csv_file(&file.value, &file.span, scene)?;
    let (mut points, mut spans) = (Vec::new(), Vec::new());
    let columns = [X, Y, Z];
    let csv = Table::new(&document, &columns, &[])?;
    for row in csv.rows() {
        points.push(point(&row, [0, 1, 2])?);
        spans.push(row.span.clone());
    }
    csv.check_plain()?;
    TargetBoundary::new(mold, &points, mesh).map_err(|fault| match fault {
        LayupError::BoundaryOffMold { point, .. } => document.error(
            spans[point].clone(),
            fault.to_string(),
            "give points of the mold in its place, and the unit in each header, as in `x (mm)`",
        ),
        _ => document.error_anywhere(fault.to_string(), "give one row for each point, in turn"),
    })
}

/// A key that says how the ply is laid on the mold.
fn laying_key(keys: &TargetTable) -> Option<&'static str> {
    [
        ("shear", keys.shear.is_some()),
        ("origin", keys.origin.is_some()),
        ("direction", keys.direction.is_some()),
        ("seed", keys.seed.is_some()),
        ("mesh", keys.mesh.is_some()),
        ("generators", keys.generators.is_some()),
        ("edges", keys.edges.is_some()),
        ("trim", keys.trim.is_some()),
    ]
    .into_iter()
    .find_map(|(key, present)| present.then_some(key))
}

/// The bytes of `[target]` itself.
fn header(table: &Located<TargetTable>, document: &Document) -> std::ops::Range<usize> {
    let text = document.text.get(table.span.clone()).unwrap_or_default();
    let length = text.find('\n').unwrap_or(text.len());
    table.span.start..table.span.start + length
}

/// A net that cannot be begun, at the key that would begin it.
fn no_net(
    keys: &TargetTable,
    table: &Located<TargetTable>,
    error: &LayupError,
    document: &Document,
) -> Error {
    let shear = keys.shear.as_ref().map(|shear| &shear.span);
    let origin = keys.origin.as_ref().map(|origin| &origin.span);
    let (key, help) = match error {
        LayupError::NetShear { .. } => (shear, "give a smaller `shear`; a ply locks long before"),
        _ => (origin, "give another `origin`, where the mold faces upwards"),
    };
    let place = key.cloned().unwrap_or_else(|| header(table, document));
    document.error(place, error.to_string(), help)
}

/// Places of the net at the grippers; refuses a ply that reaches beyond the mold or folds.
fn at_grippers(
    net: &Net,
    ply: &Ply,
    mold: &Mold,
    table: &Located<TargetTable>,
    document: &Document,
) -> Result<Vec<[f64; 3]>, Error> {
    let places: Vec<Option<[f64; 3]>> =
        (0..ply.grippers()).map(|index| net.place_or_node(mold, ply.place(index))).collect();
    let missing = places.iter().filter(|place| place.is_none()).count();
    let Some(first) = places.iter().position(Option::is_none) else {
        return Ok(places.into_iter().flatten().collect());
    };
    let id = gripper_name(ply.id(first));
    // of the node that is nearest in the fabric
    let [u, v] = ply.place(first);
    let away = |missing: &&Missing| {
        let [p, q] = net.placement.fabric(missing.node);
        (p - u).hypot(q - v)
    };
    let reason = net.missing.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
    let (fault, help) = match reason.map(|missing| (missing.reason, missing.beyond)) {
        Some((Reason::OffMold, beyond)) => (
            match beyond {
                Some(beyond) => {
                    format!("lies {} mm beyond the boundary of the mold", round(beyond * 1e3))
                }
                None => "lies beyond the boundary of the mold".into(),
            },
            "the ply reaches over the mold's boundary: move `origin` or turn `direction`, or take a larger mold or a smaller ply",
        ),
        Some((Reason::Folded, _)) => (
            "lies where the net folds".into(),
            "the ply cannot lie there without a fold: move `origin` or `seed` towards the middle of the ply, or take a smaller ply",
        ),
        _ => (
            "lies behind a fold of the net".into(),
            "the ply folds on its way there: move `origin` or `seed` towards the middle of the ply, or take a smaller ply",
        ),
    };
    let cause = match (mold, reason.map(|missing| missing.reason)) {
        (Mold::Mesh(mesh), Some(Reason::OffMold)) => {
            mesh.gaps(usual_width(ply)).map(|gaps| gaps.warning())
        }
        (Mold::Mesh(mesh), _) => detail(mesh, ply),
        _ => None,
    };
    let help = match (cause, too_small(mold, ply)) {
        (Some(cause), _) => format!("{cause}; or {help}"),
        (None, Some(sizes)) if missing > 1 => format!("{sizes}; {help}"),
        _ => help.into(),
    };
    let count = ply.grippers();
    let have = if missing == 1 { "gripper has" } else { "grippers have" };
    Err(document.error(
        header(table, document),
        format!("{missing} of {count} {have} no place on the mold: gripper {id} {fault}"),
        help,
    ))
}

/// A detail that is too wide to be spanned unasked, or cannot be, and too narrow for the ply to follow it without a fold.
fn detail(mesh: &Mesh, ply: &Ply) -> Option<String> {
    let tolerance = ContactSettings::default().tolerance;
    let details = mesh.details(FOLDING * usual_width(ply), tolerance);
    let detail = details.first()?;
    let width = (1e3 * detail.width).floor() + 1.0;
    let remedy = match detail.kind {
        DetailKind::Pit => {
            format!("fill it, or have the ply span it with spanned = \"{width} mm\" in [mold]")
        }
        DetailKind::Hole => "fill it".into(),
        DetailKind::Stud => "cut it off".into(),
    };
    Some(format!("the mold has {}: {remedy}", detail.text()))
}

/// Of a mesh that is smaller than the ply, the sizes of both: its unit may be wrong.
fn too_small(mold: &Mold, ply: &Ply) -> Option<String> {
    let Mold::Mesh(mesh) = mold else {
        return None;
    };
    let ([low, high], [from, to]) = (mesh.bounds(), ply.bounds(0.0));
    let [x, y, z] = [0, 1, 2].map(|n| high[n] - low[n]);
    let [u, v] = [0, 1].map(|n| to[n] - from[n]);
    if x.hypot(y) >= u.hypot(v) {
        return None;
    }
    let millimeters = |side: f64| round(1e3 * side);
    let [x, y, z, u, v] = [x, y, z, u, v].map(millimeters);
    Some(format!(
        "the mold measures {x} × {y} × {z} mm and the ply {u} × {v} mm: if the mold is larger, change its `unit`"
    ))
}
