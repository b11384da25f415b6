//! A tree of bounding boxes over the triangles of a mesh, for queries that concern few of them.
//!
//! Triangles are split at the median of the middles of their boxes, along the longest side of the box around these
//! middles, and each half once more: a node has four children, and n triangles lie ⌈log₄ n⌉ levels deep. The four
//! boxes of a node lie side by side in memory, and a point is compared with all of them at once. The search for the
//! closest triangle is the branch and bound of Roussopoulos et al. 1995: the nearest box comes first, and no box is
//! opened that is farther away than the best triangle so far.

use super::bounds;
use super::triangle::{Closest, closest};

/// Children of a node.
const CHILDREN: usize = 4;
/// Most boxes that wait in a search: for each of the 16 levels of 2³² triangles three, and the one that is next.
const WAITING: usize = (CHILDREN - 1) * 16 + 1;

/// A tree over triangles, which are numbered in the order in which they came.
#[derive(Clone)]
pub(super) struct Tree {
    /// The root first.
    nodes: Vec<Node>,
}

/// The box of a triangle, by its lowest and highest coordinates (m), and its number.
type Item = ([[f64; 3]; 2], u32);

/// Four boxes with what is in them; it fills two cache lines of 64 bytes.
#[derive(Clone)]
#[repr(align(64))]
struct Node {
    /// Lowest coordinates (m), by axis and then by child; infinite where there is no child. Single precision, rounded
    /// outwards, because a search spends most of its time on waiting for memory.
    low: [[f32; CHILDREN]; 3],
    /// Highest coordinates (m), likewise.
    high: [[f32; CHILDREN]; 3],
    children: [Child; CHILDREN],
}

#[derive(Clone, Copy)]
enum Child {
    None,
    /// Number of a node.
    Node(u32),
    /// Number of a triangle.
    Triangle(u32),
}

impl Tree {
    /// Over triangles given by their boxes (m).
    pub fn new(boxes: impl Iterator<Item = [[f64; 3]; 2]>) -> Self {
        let mut items: Vec<Item> = boxes.zip(0..).collect();
        let mut tree = Tree { nodes: Vec::with_capacity(items.len() / 2) };
        tree.add(&mut items);
        tree
    }

    /// Adds a node over some triangles; returns its number.
    fn add(&mut self, items: &mut [Item]) -> u32 {
        let number = self.nodes.len();
        let (low, high) = ([[f32::INFINITY; CHILDREN]; 3], [[f32::NEG_INFINITY; CHILDREN]; 3]);
        self.nodes.push(Node { low, high, children: [Child::None; CHILDREN] });
        let (first, second) = halves(items);
        let ((a, b), (c, d)) = (halves(first), halves(second));
        for (n, part) in [a, b, c, d].into_iter().enumerate() {
            let [low, high] = bounds(part.iter().flat_map(|(own, _)| *own));
            let child = match part {
                [] => continue,
                [(_, triangle)] => Child::Triangle(*triangle),
                _ => Child::Node(self.add(part)),
            };
            let node = &mut self.nodes[number];
            node.children[n] = child;
            for axis in 0..3 {
                node.low[axis][n] = below(low[axis]);
                node.high[axis][n] = -below(-high[axis]);
            }
        }
        number as u32
    }

    /// The triangle closest to `p` (m) and its point there, from the corners of each triangle (m); `None` if the square
    /// of its distance is not less than `most` (m²).
    pub fn closest(
        &self,
        p: [f64; 3],
        mut most: f64,
        corners: impl Fn(u32) -> [[f64; 3]; 3],
    ) -> Option<(u32, Closest)> {
        let mut best = None;
        let mut waiting = [(0.0, Child::Node(0)); WAITING];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (square, child) = waiting[count];
            if square >= most {
                continue;
            }
            match child {
                Child::None => {}
                Child::Triangle(triangle) => {
                    let closest = closest(corners(triangle), p);
                    if closest.square < most {
                        most = closest.square;
                        best = Some((triangle, closest));
                    }
                }
                Child::Node(node) => {
                    let node = &self.nodes[node as usize];
                    let squares = node.squares(p);
                    // the nearest last, because it is looked at first
                    let mut least = f64::INFINITY;
                    for n in 0..CHILDREN {
                        if squares[n] < most {
                            waiting[count] = (squares[n], node.children[n]);
                            if squares[n] <= least {
                                least = squares[n];
                            } else {
                                waiting.swap(count - 1, count);
                            }
                            count += 1;
                        }
                    }
                }
            }
        }
        best
    }

    /// All triangles whose boxes touch the box between two corners (m), in no particular order.
    pub fn touching(&self, [low, high]: [[f64; 3]; 2]) -> impl Iterator<Item = u32> + '_ {
        let mut waiting = vec![Child::Node(0)];
        std::iter::from_fn(move || {
            while let Some(child) = waiting.pop() {
                match child {
                    Child::None => {}
                    Child::Triangle(triangle) => return Some(triangle),
                    Child::Node(node) => {
                        let node = &self.nodes[node as usize];
                        let touches = |n: &usize| {
                            (0..3).all(|a| {
                                f64::from(node.low[a][*n]) <= high[a]
                                    && low[a] <= f64::from(node.high[a][*n])
                            })
                        };
                        waiting.extend((0..CHILDREN).filter(touches).map(|n| node.children[n]));
                    }
                }
            }
            None
        })
    }
}

impl Node {
    /// Squares of the distances of a point from the boxes of the children (m²); infinite without a child.
    #[inline]
    fn squares(&self, p: [f64; 3]) -> [f64; CHILDREN] {
        let mut squares = [0.0; CHILDREN];
        for axis in 0..3 {
            let (low, high) = (self.low[axis], self.high[axis]);
            for n in 0..CHILDREN {
                let (below, above) = (f64::from(low[n]) - p[axis], p[axis] - f64::from(high[n]));
                let outside = larger(0.0, larger(below, above));
                squares[n] += outside * outside;
            }
        }
        squares
    }
}

/// Splits triangles at the median along the longest side of the box around the middles of their boxes.
fn halves(items: &mut [Item]) -> (&mut [Item], &mut [Item]) {
    let middle = |[low, high]: [[f64; 3]; 2]| [0, 1, 2].map(|n| 0.5 * (low[n] + high[n]));
    let [low, high] = bounds(items.iter().map(|(own, _)| middle(*own)));
    let side = [0, 1, 2].map(|n| high[n] - low[n]);
    let axis = (0..3).fold(0, |longest, n| if side[n] > side[longest] { n } else { longest });
    let half = items.len().div_ceil(2);
    if half < items.len() {
        // equal middles in the order of their numbers
        items.select_nth_unstable_by(half, |(a, m), (b, n)| {
            middle(*a)[axis].total_cmp(&middle(*b)[axis]).then(m.cmp(n))
        });
    }
    items.split_at_mut(half)
}

/// The larger of two numbers, without the care that `f64::max` takes of what is no number.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The largest number of single precision that is not above `x`.
fn below(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x { near.next_down() } else { near }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Corners = [[f64; 3]; 3];

    /// Triangles of random places and of sizes from 1e-4 to 1 of the space they lie in.
    fn soup() -> impl Strategy<Value = Vec<Corners>> {
        let triangle =
            (prop::array::uniform3(-1.0..1.0), prop::array::uniform9(-1.0..1.0), -4.0..0.0);
        let corners = triangle.prop_map(|(place, shape, size): ([f64; 3], [f64; 9], f64)| {
            let size = 10f64.powf(size);
            [0, 1, 2].map(|k| [0, 1, 2].map(|c| place[c] + size * shape[3 * k + c]))
        });
        prop::collection::vec(corners, 1..200)
    }

    /// A wavy sheet whose cells shrink towards one corner by four orders of magnitude, as in a graded mesh.
    fn graded() -> impl Strategy<Value = Vec<Corners>> {
        (1..12_i32, 1..12_i32, 0.0..0.3).prop_map(|(nx, ny, height)| {
            let side = |k: i32, n: i32| 10f64.powf(4.0 * f64::from(k - n) / f64::from(n));
            let vertex = |[i, j]: [i32; 2]| {
                let (x, y) = (side(i, nx), side(j, ny));
                [x, y, height * (7.0 * x).sin() * (5.0 * y).cos()]
            };
            let cells = (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j)));
            cells
                .flat_map(|(i, j)| {
                    let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(vertex);
                    [[a, b, c], [a, c, d]]
                })
                .collect()
        })
    }

    fn tree(triangles: &[Corners]) -> Tree {
        Tree::new(triangles.iter().map(|corners| bounds(corners.iter().copied())))
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// No triangle is closer than the one that is found, and none is found that is not closer than the bound. The
        /// boxes are compared with the bound as they are rounded, hence 1e-12.
        #[test]
        fn the_closest_triangle_is_the_closest_of_all(
            triangles in prop_oneof![soup(), graded()],
            p in prop::array::uniform3(-1.5..1.5),
            share in 0.1..3.0,
        ) {
            let least = triangles.iter().map(|t| closest(*t, p).square).fold(f64::INFINITY, f64::min);
            let tree = tree(&triangles);
            let corners = |n: u32| triangles[n as usize];
            let (number, found) = tree.closest(p, f64::MAX, corners).expect("there are triangles");
            prop_assert_eq!(closest(corners(number), p).square, found.square);
            prop_assert!(found.square <= least * (1.0 + 1e-12));
            let bounded = tree.closest(p, share * found.square, corners);
            prop_assert_eq!(bounded.map(|(_, c)| c.square), (share > 1.0).then_some(found.square));
        }

        /// Boxes are rounded to single precision, so that some are found that miss the region by 1e-6.
        #[test]
        fn all_triangles_whose_boxes_touch_a_region_are_found_once(
            triangles in prop_oneof![soup(), graded()],
            p in prop::array::uniform3(-1.0..1.0),
            half in prop::array::uniform3(0.0..0.5),
            corner in prop::option::of(any::<prop::sample::Index>()),
        ) {
            // a region without size at a corner of a triangle touches its box, and no rounding may cut it off
            let (p, half) = corner.map_or((p, half), |index| (index.get(&triangles)[1], [0.0; 3]));
            let region = [[0, 1, 2].map(|c| p[c] - half[c]), [0, 1, 2].map(|c| p[c] + half[c])];
            let touching = |margin: f64| {
                let touches = |corners: &Corners| {
                    let [low, high] = bounds(corners.iter().copied());
                    (0..3).all(|c| low[c] - margin <= region[1][c] && region[0][c] - margin <= high[c])
                };
                let numbers = (0..).zip(&triangles).filter(move |(_, t)| touches(t)).map(|(n, _)| n);
                numbers.collect::<Vec<u32>>()
            };
            let mut found: Vec<u32> = tree(&triangles).touching(region).collect();
            found.sort_unstable();
            prop_assert!(found.windows(2).all(|pair| pair[0] < pair[1]));
            prop_assert!(touching(0.0).iter().all(|n| found.contains(n)));
            let near = touching(1e-6);
            prop_assert!(found.iter().all(|n| near.contains(n)));
        }
    }
}
