//! The highest point of a mesh at a place.

use super::Mesh;
use crate::mold::tuning::TUNING;

impl Mesh {
    /// The highest point of the mesh at the place (x, y) (m); `None` beside the mesh.
    #[must_use]
    pub fn highest_point(&self, [x, y]: [f64; 2]) -> Option<[f64; 3]> {
        let mut top: Option<f64> = None;
        for triangle in self.tree.touching([[x, y, f64::NEG_INFINITY], [x, y, f64::INFINITY]]) {
            let corners = self.corners(triangle as usize);
            // weights of the corners in plan, times twice the area there
            let weights = [1, 2, 0].map(|k| {
                let (p, q) = (corners[k], corners[(k + 1) % 3]);
                (p[0] - x) * (q[1] - y) - (q[0] - x) * (p[1] - y)
            });
            let area: f64 = weights.iter().sum();
            let weights = weights.map(|w| w / area);
            // an upright triangle has no area in plan; its upper edge belongs to its neighbor as well
            if weights.iter().all(|w| *w >= -TUNING.outside_in_plan) {
                let z = (0..3).map(|k| weights[k] * corners[k][2]).sum();
                top = Some(top.map_or(z, |top: f64| top.max(z)));
            }
        }
        top.map(|z| [x, y, z])
    }
}
