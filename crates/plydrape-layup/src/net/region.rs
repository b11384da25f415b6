//! Where a draped ply is seen from above, for what is laid on it.

use super::Net;
use crate::mold::Mold;

impl Net {
    /// The rings in plan (m) within which the ply lies, holes among them: its boundary on the `mold` it was draped on, as the
    /// bare mold below it has its places. Where the ply reaches beyond the mold its boundary is closed by a straight line. `None`
    /// for a strip without width.
    #[must_use]
    pub fn region(&self, mold: &Mold, bare: &Mold) -> Option<Vec<Vec<[f64; 2]>>> {
        let boundary = self.boundary(mold)?;
        let last = boundary.lines.iter().map(|line| line.ring).max()?;
        let ring = |number: usize| -> Vec<[f64; 2]> {
            let lines = boundary.lines.iter().filter(|line| line.ring == number);
            let points = lines.flat_map(|line| &line.points);
            let plan = |place: [f64; 3]| {
                let [x, y, _] = bare.closest_point(place).point;
                [x, y]
            };
            points.map(|point| plan(point.place)).collect()
        };
        let rings = (0..=last).map(ring).filter(|ring| ring.len() >= 3).collect::<Vec<_>>();
        (!rings.is_empty()).then_some(rings)
    }
}
