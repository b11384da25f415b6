//! Which triangles are near: boxes within boxes.
//!
//! Each box is cut in two across its longest side at the median of what it holds, down to a few triangles.
//! Triangles are stored in the order of the tree, so that what is near in space is near in memory.

/// Most triangles of a box that is not cut further.
const FEW: usize = 4;
/// Boxes that wait to be looked at; each cut halves the triangles, so 2³² of them need 32.
const WAITING: usize = 40;

/// A box around triangles: its lowest and highest coordinates (m).
pub(super) type Bounds = [[f64; 3]; 2];

/// A box with what it holds.
#[derive(Debug, Clone)]
struct Node {
    bounds: Bounds,
    /// Of a box that is cut, the first of its two parts, which stand side by side; else its first triangle.
    first: u32,
    /// How many triangles it holds; zero if it is cut.
    count: u32,
}

/// A tree over triangles.
#[derive(Debug, Clone)]
pub(super) struct Tree {
    nodes: Vec<Node>,
}

impl Tree {
    /// Over triangles by the boxes around them (m). Also gives the order in which the triangles are to be
    /// stored: the tree knows them by their place in it.
    pub fn new(boxes: &[Bounds]) -> (Self, Vec<u32>) {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::with_capacity(boxes.len());
        let mut open = vec![(0, 0, boxes.len())];
        nodes.push(node(boxes, &order, 0, boxes.len()));
        while let Some((n, start, end)) = open.pop() {
            if end - start <= FEW {
                continue;
            }
            // twice the middle of a box, along the side over which the middles spread most
            let middle = |triangle: u32, axis: usize| {
                let [low, high] = boxes[triangle as usize];
                low[axis] + high[axis]
            };
            let part = &mut order[start..end];
            let spread = |axis| {
                let range = part.iter().map(|t| middle(*t, axis));
                range.clone().fold(f64::NEG_INFINITY, f64::max)
                    - range.fold(f64::INFINITY, f64::min)
            };
            let spreads = [0, 1, 2].map(spread);
            let axis = (0..3).fold(0, |best, n| if spreads[n] > spreads[best] { n } else { best });
            let half = part.len() / 2;
            part.select_nth_unstable_by(half, |a, b| middle(*a, axis).total_cmp(&middle(*b, axis)));
            let (cut, first) = (start + half, nodes.len());
            nodes.push(node(boxes, &order, start, cut));
            nodes.push(node(boxes, &order, cut, end));
            nodes[n].first = first as u32;
            nodes[n].count = 0;
            open.push((first, start, cut));
            open.push((first + 1, cut, end));
        }
        (Tree { nodes }, order)
    }

    /// Asks for the distance to one triangle after the other, nearer boxes first, as long as a box is nearer
    /// than what has been found. `look` is given a triangle and the least square so far (m²), and
    /// returns the new least.
    #[inline]
    pub fn nearest(&self, p: [f64; 3], mut look: impl FnMut(usize, f64) -> f64) {
        let mut least = f64::INFINITY;
        let mut waiting = [(0.0, 0u32); WAITING];
        let mut count = 0;
        let mut n = 0;
        loop {
            let node = &self.nodes[n];
            if node.count > 0 {
                for triangle in node.first..node.first + node.count {
                    least = look(triangle as usize, least);
                }
            } else {
                let first = node.first as usize;
                let squares = [first, first + 1].map(|n| square_to(&self.nodes[n].bounds, p));
                let swap = usize::from(squares[1] < squares[0]);
                if squares[1 - swap] < least {
                    waiting[count] = (squares[1 - swap], (first + 1 - swap) as u32);
                    count += 1;
                }
                if squares[swap] < least {
                    n = first + swap;
                    continue;
                }
            }
            loop {
                if count == 0 {
                    return;
                }
                count -= 1;
                if waiting[count].0 < least {
                    n = waiting[count].1 as usize;
                    break;
                }
            }
        }
    }

    /// Every triangle in boxes that `enter` accepts.
    pub fn visit(&self, enter: impl Fn(&Bounds) -> bool, mut look: impl FnMut(usize)) {
        let mut waiting = [0u32; WAITING];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let node = &self.nodes[waiting[count] as usize];
            if !enter(&node.bounds) {
                continue;
            }
            if node.count > 0 {
                (node.first..node.first + node.count).for_each(|triangle| look(triangle as usize));
            } else {
                waiting[count] = node.first + 1;
                waiting[count + 1] = node.first;
                count += 2;
            }
        }
    }
}

/// The box around some triangles, not cut.
fn node(boxes: &[Bounds], order: &[u32], start: usize, end: usize) -> Node {
    let corners = order[start..end].iter().flat_map(|n| &boxes[*n as usize]);
    Node { bounds: super::bounds(corners), first: start as u32, count: (end - start) as u32 }
}

/// Square of the distance from a box to a point (m²).
#[inline]
fn square_to([low, high]: &Bounds, p: [f64; 3]) -> f64 {
    let outside = |n: usize| (low[n] - p[n]).max(p[n] - high[n]).max(0.0);
    let [x, y, z] = [outside(0), outside(1), outside(2)];
    x * x + y * y + z * z
}
