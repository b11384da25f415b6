//! What is possible but hardly meant of a mold that is a mesh: every command that drapes on it says so.

use plydrape::geometry::vector::{cross, norm, sub};
use plydrape::mold::{Mesh, MeshReport, Mold};

/// Largest relief of a flat side, as a share of the size of a mold.
const FLAT: f64 = 1e-4;
/// Least relief of a shaped side, as a share of the size of a mold.
const SHAPED: f64 = 0.02;
/// Share of a triangle's normal along z below which it is a wall.
const WALL: f64 = 0.1;

/// Every warning about the mesh of a mold, in a sentence; none for another mold.
pub fn warnings(mold: Option<&Mold>, report: Option<&MeshReport>) -> Vec<String> {
    let (Some(Mold::Mesh(mesh)), Some(report)) = (mold, report) else { return Vec::new() };
    upside_down(mesh, report).into_iter().chain(report.warnings()).collect()
}

/// A mesh that seems to lie upside down: an open one whose file says that its other side is the outer one, or a solid that is
/// flat from above and shaped from below.
fn upside_down(mesh: &Mesh, report: &MeshReport) -> Option<String> {
    let turn = "turn it with rotation = [\"180 deg\", 0, 0] in [mold]";
    if report.closed == 0 && 2 * report.flipped.count > report.triangles {
        return Some(format!(
            "{} of {} triangles of the mold face down in its file, and the ply comes from above onto their other side; if the mold is upside down, {turn}",
            report.flipped.count, report.triangles
        ));
    }
    if report.closed < report.surfaces {
        return None;
    }
    let [low, high] = mesh.bounds();
    let size = [0, 1, 2].map(|n| high[n] - low[n]).into_iter().fold(0.0, f64::hypot);
    let [above, below] = [1.0, -1.0].map(|side| relief(mesh, side));
    (above < FLAT * size && below > SHAPED * size).then(|| {
        format!(
            "the mold is flat from above and shaped from below; if it is upside down, {turn}; if it is meant, kind = \"plane\" says the same"
        )
    })
}

/// Height over which the triangles of a mesh go that face up (side 1) or down (side −1) (m).
fn relief(mesh: &Mesh, side: f64) -> f64 {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for corners in mesh.triangles() {
        let [a, b, c] = corners.map(|n| mesh.vertices()[n as usize]);
        let normal = cross(sub(b, a), sub(c, a));
        if side * normal[2] > WALL * norm(normal) {
            low = [a, b, c].into_iter().fold(low, |low, corner| low.min(corner[2]));
            high = [a, b, c].into_iter().fold(high, |high, corner| high.max(corner[2]));
        }
    }
    (high - low).max(0.0)
}
