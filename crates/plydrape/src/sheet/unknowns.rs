//! Which unknowns carry each node.
//!
//! A free node has a block of three unknowns. A node that a gripper holds at one point follows the gripper. A node of a pad
//! follows the pad's turn δθ by δx = δθ × a, a its arm, and the pad's shift where its mount is not rigid; a pad without a
//! joint has no turn of its own.

use super::Sheet;
use super::pads::HeldNodes;

/// What carries a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Carrier {
    /// Unknowns of the node alone.
    Free {
        /// Block of the unknowns.
        block: u32,
    },
    /// A gripper's point.
    Held {
        /// The gripper.
        gripper: u32,
    },
    /// A gripper's pad.
    Pad {
        /// The gripper.
        gripper: u32,
        /// Block of the pad's turn; `None` if the pad has no joint.
        turn: Option<u32>,
        /// Block of the pad's shift; `None` if the pad's mount is rigid.
        shift: Option<u32>,
    },
}

impl Carrier {
    /// The blocks that carry the node: its own, or a pad's turn and shift.
    pub fn blocks(self) -> [Option<u32>; 2] {
        match self {
            Carrier::Free { block } => [Some(block), None],
            Carrier::Held { .. } => [None, None],
            Carrier::Pad { turn, shift, .. } => [turn, shift],
        }
    }
}

/// The carriers of all nodes, and how many blocks of unknowns they have.
pub fn carriers(sheet: &Sheet, held: &[HeldNodes]) -> (Vec<Carrier>, usize) {
    let mut carriers = vec![None; sheet.fabric.places.len()];
    let mut blocks = 0..;
    let mut block = || blocks.next().unwrap_or_default();

    // pads first: of one node, or of more that turn and shift with it
    let tilts = sheet.tool.as_ref().is_none_or(|tool| tool.fixed_pads.is_none());
    for (gripper, (g, nodes)) in (0..).zip(sheet.grippers.iter().zip(held)) {
        match nodes.as_slice() {
            [] => {}
            [(node, _)] => {
                if g.mount.is_none() {
                    carriers[*node] = Some(Carrier::Held { gripper });
                }
            }
            nodes => {
                let turn = tilts.then(&mut block);
                let shift = g.mount.map(|_| block());
                for (node, _) in nodes {
                    carriers[*node] = Some(Carrier::Pad { gripper, turn, shift });
                }
            }
        }
    }

    // all others are free
    let free =
        |carrier: Option<Carrier>| carrier.unwrap_or_else(|| Carrier::Free { block: block() });
    let carriers: Vec<Carrier> = carriers.into_iter().map(free).collect();
    let count = block() as usize;
    (carriers, count)
}

/// The pairs of nodes that a term of the energy couples.
pub fn coupled_pairs(sheet: &Sheet) -> Vec<[u32; 2]> {
    let fabric = &sheet.fabric;
    let segments = fabric.segments.iter().map(|s| s.nodes);
    let bends = fabric.bends.iter().map(|b| [b.nodes[0], b.nodes[2]]);
    let cells = fabric.cells.iter().flat_map(|c| {
        let [p, q, r, s] = c.nodes;
        [[p, q], [q, r], [r, s], [s, p], [p, r], [q, s]]
    });
    let lips = sheet.grippers.iter().flat_map(|gripper| {
        let nodes = gripper.lip.nodes.iter().map(|(node, _)| *node as u32);
        nodes.clone().flat_map(move |a| nodes.clone().filter(move |b| *b < a).map(move |b| [b, a]))
    });
    segments.chain(bends).chain(cells).chain(lips).collect()
}
