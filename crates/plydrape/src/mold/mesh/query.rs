//! Which triangles are near: the bounding boxes of all triangles in a tree.
//!
//! The only file that knows the library behind it and its vector types.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhLeafCost, BvhNode};

/// A tree over boxes.
#[derive(Clone)]
pub(super) struct Tree {
    boxes: Bvh,
}

/// A candidate for the nearest, by the square of its distance (m²).
pub(super) struct Near<T> {
    pub square: f64,
    pub what: T,
}

impl<T> BvhLeafCost for Near<T> {
    fn cost(&self) -> f64 {
        self.square
    }
}

impl Tree {
    /// Over boxes given by their lowest and highest coordinates (m).
    pub fn new(boxes: impl Iterator<Item = [[f64; 3]; 2]>) -> Self {
        let boxes =
            boxes.map(|[low, high]| Aabb::new(Vector::from(low), Vector::from(high))).enumerate();
        Tree { boxes: Bvh::from_iter(BvhBuildStrategy::Binned, boxes) }
    }

    /// The item nearest to `p` (m); none if the square of its distance is not less than `most` (m²).
    pub fn nearest<T>(
        &self,
        p: [f64; 3],
        most: f64,
        distance: impl Fn(u32) -> Near<T>,
    ) -> Option<(u32, Near<T>)> {
        let p = Vector::from(p);
        let to_box = |node: &BvhNode, _| {
            let outside = (node.mins() - p).max(p - node.maxs()).max(Vector::ZERO);
            outside.length_squared()
        };
        self.boxes.find_best(most.min(f64::MAX), to_box, |item, _| Some(distance(item)))
    }

    /// All items whose boxes reach within `tolerance` of `p` (m).
    pub fn touching(&self, p: [f64; 3], tolerance: f64) -> impl Iterator<Item = u32> + '_ {
        let [low, high] = [p.map(|x| x - tolerance), p.map(|x| x + tolerance)].map(Vector::from);
        self.boxes.leaves(move |node| node.mins().cmple(high).all() && node.maxs().cmpge(low).all())
    }

    /// All items whose boxes lie above or below the place (x, y) (m).
    pub fn over(&self, [x, y]: [f64; 2]) -> impl Iterator<Item = u32> + '_ {
        self.boxes.leaves(move |node| {
            let (low, high) = (node.mins(), node.maxs());
            low.x <= x && x <= high.x && low.y <= y && y <= high.y
        })
    }
}
