//! Which nodes are coupled.

/// The neighbours of every node.
#[derive(Debug, Clone)]
pub struct Graph {
    /// Where the neighbours of each node begin; n + 1 entries.
    starts: Vec<usize>,
    /// Neighbours, ascending for each node.
    neighbours: Vec<u32>,
}

impl Graph {
    /// The graph of pairs of different nodes, each named once.
    pub fn new(nodes: usize, pairs: &[[u32; 2]]) -> Self {
        let mut starts = vec![0; nodes + 1];
        for pair in pairs {
            for &node in pair {
                starts[node as usize + 1] += 1;
            }
        }
        for i in 0..nodes {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut neighbours = vec![0; 2 * pairs.len()];
        for &[i, j] in pairs {
            for (node, other) in [(i, j), (j, i)] {
                neighbours[next[node as usize]] = other;
                next[node as usize] += 1;
            }
        }
        for node in 0..nodes {
            neighbours[starts[node]..starts[node + 1]].sort_unstable();
        }
        Self { starts, neighbours }
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.starts.len() - 1
    }

    /// The nodes that a node is coupled to, ascending.
    pub fn neighbours(&self, node: u32) -> &[u32] {
        &self.neighbours[self.starts[node as usize]..self.starts[node as usize + 1]]
    }
}
