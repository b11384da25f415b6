//! Which nodes are coupled.

/// The neighbors of every node.
#[derive(Debug, Clone)]
pub struct Graph {
    /// Where the neighbors of each node begin; n + 1 entries.
    starts: Vec<usize>,
    /// Neighbors, ascending for each node.
    neighbors: Vec<u32>,
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
        let mut neighbors = vec![0; 2 * pairs.len()];
        for &[i, j] in pairs {
            for (node, other) in [(i, j), (j, i)] {
                neighbors[next[node as usize]] = other;
                next[node as usize] += 1;
            }
        }
        for node in 0..nodes {
            neighbors[starts[node]..starts[node + 1]].sort_unstable();
        }
        Self { starts, neighbors }
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.starts.len() - 1
    }

    /// The nodes that a node is coupled to, ascending.
    pub fn neighbors(&self, node: u32) -> &[u32] {
        &self.neighbors[self.starts[node as usize]..self.starts[node as usize + 1]]
    }

    /// An order of elimination with little fill: approximate minimum degree, Amestoy, Davis and Duff 1996.
    pub fn minimum_degree_order(&self) -> Vec<u32> {
        // the columns of the whole matrix with its diagonal, as the algorithm takes them
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for node in 0..self.nodes() {
            let neighbors = self.neighbors(node as u32).iter().map(|&other| other as usize);
            rows.extend(neighbors.chain([node]));
            rows[starts[node]..].sort_unstable();
            starts.push(rows.len());
        }
        match amd::order(self.nodes(), &starts, &rows, &amd::Control::default()) {
            Ok((order, ..)) => order.into_iter().map(|node| node as u32).collect(),
            Err(status) => unreachable!("the columns are sorted: {status:?}"),
        }
    }
}
