//! Nested dissection of the nodes by their places on the fabric.
//!
//! A set of nodes is cut across at a fabric line. The nodes of one side that are coupled to the other side are the
//! separator: without them the two sides have no coupling, whatever the graph is. They are eliminated last, after both
//! sides, which are divided in the same way. George 1973, "Nested dissection of a regular finite element mesh".

use super::graph::Graph;
use super::tuning::Tuning;

/// Nodes in the order of elimination, in groups that are eliminated together; separators follow what they separate.
pub fn dissect(graph: &Graph, places: &[[f64; 2]], tuning: &Tuning) -> Vec<Vec<u32>> {
    let mut dissection = Dissection {
        graph,
        places,
        tuning,
        part: vec![Part::Elsewhere; graph.nodes()],
        groups: Vec::new(),
    };
    dissection.divide((0..graph.nodes() as u32).collect());
    dissection.groups
}

/// On which side of the cut under trial a node is.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Elsewhere,
    First,
    Second,
}

struct Dissection<'a> {
    graph: &'a Graph,
    places: &'a [[f64; 2]],
    tuning: &'a Tuning,
    part: Vec<Part>,
    groups: Vec<Vec<u32>>,
}

/// A cut of a set of nodes into two sides and their separator.
struct Cut {
    score: f64,
    sides: [Vec<u32>; 2],
    separator: Vec<u32>,
}

impl Dissection<'_> {
    fn divide(&mut self, nodes: Vec<u32>) {
        if nodes.len() > self.tuning.leaf_nodes
            && let Some(cut) = self.best_cut(&nodes)
        {
            for side in cut.sides {
                self.divide(side);
            }
            self.groups.push(cut.separator);
        } else if !nodes.is_empty() {
            self.groups.push(nodes);
        }
    }

    /// The cut with the best score among those at lines near the median of either fabric coordinate.
    fn best_cut(&mut self, nodes: &[u32]) -> Option<Cut> {
        let mut best: Option<Cut> = None;
        for axis in 0..2 {
            let key = |node: u32| {
                let place = self.places[node as usize];
                (place[axis], place[1 - axis])
            };
            let mut sorted = nodes.to_vec();
            sorted.sort_unstable_by(|&a, &b| {
                let (ka, kb) = (key(a), key(b));
                ka.0.total_cmp(&kb.0).then(ka.1.total_cmp(&kb.1)).then(a.cmp(&b))
            });
            for at in self.cuts(&sorted, axis) {
                if let Some(cut) = self.cut(&sorted, at)
                    && best.as_ref().is_none_or(|b| cut.score < b.score)
                {
                    best = Some(cut);
                }
            }
        }
        best
    }

    /// Where sorted nodes may be cut: between fabric lines, as near as possible to evenly spaced shares about the half.
    fn cuts(&self, sorted: &[u32], axis: usize) -> Vec<usize> {
        let n = sorted.len();
        let line = |k: usize| self.places[sorted[k] as usize][axis];
        let ends: Vec<usize> = (1..n).filter(|&k| line(k) > line(k - 1)).collect();
        let tries = self.tuning.cut_trials;
        let mut cuts: Vec<usize> = (0..tries)
            .filter_map(|trial| {
                let share =
                    0.5 + self.tuning.cut_spread * ((trial as f64 + 0.5) / tries as f64 - 0.5);
                let wanted = (share * n as f64).round() as usize;
                let after = ends.partition_point(|&k| k < wanted);
                let near = ends[after.saturating_sub(1)..(after + 1).min(ends.len())].iter();
                near.min_by_key(|k| k.abs_diff(wanted)).copied()
            })
            .collect();
        if cuts.is_empty() {
            cuts.push(n / 2);
        }
        cuts.sort_unstable();
        cuts.dedup();
        cuts
    }

    /// Cuts sorted nodes before entry `at`; nothing if this leaves a side empty.
    fn cut(&mut self, sorted: &[u32], at: usize) -> Option<Cut> {
        let (first, second) = sorted.split_at(at);
        for (side, part) in [(first, Part::First), (second, Part::Second)] {
            for &node in side {
                self.part[node as usize] = part;
            }
        }
        let touches = |node: u32, part: Part| {
            self.graph.neighbours(node).iter().any(|&other| self.part[other as usize] == part)
        };
        let split = |side: &[u32], other: Part| -> (Vec<u32>, Vec<u32>) {
            side.iter().partition(|&&node| touches(node, other))
        };
        let (a, b) = (split(first, Part::Second), split(second, Part::First));
        for &node in sorted {
            self.part[node as usize] = Part::Elsewhere;
        }
        // the thinner boundary separates; the side it is taken from loses it
        let from_first =
            if a.0.len() == b.0.len() { a.1.len() >= b.1.len() } else { a.0.len() < b.0.len() };
        let (separator, sides) =
            if from_first { (a.0, [a.1, second.to_vec()]) } else { (b.0, [first.to_vec(), b.1]) };
        if sides.iter().any(Vec::is_empty) {
            return None;
        }
        let larger = sides[0].len().max(sides[1].len()) as f64 / sorted.len() as f64;
        let score = separator.len() as f64 * (1.0 + self.tuning.balance * larger);
        Some(Cut { score, sides, separator })
    }
}
