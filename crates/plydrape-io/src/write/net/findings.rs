//! What is found of a ply on its mold beside the nodes of its net.

use plydrape::mold::Mold;
use plydrape::net::{Boundary, Net, Seeds, SharpEdges, TargetBoundary, Trim};

/// What is found of a ply on its mold beside the nodes of its net.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Findings {
    /// Boundary on the mold; `None` for a strip without width.
    pub boundary: Option<Boundary>,
    /// Sharp edges of the mold under it; `None` where the mold has no edges to tell.
    pub sharp_edges: Option<SharpEdges>,
    /// How far its boundary is from the target boundary, if there is one.
    pub trim: Option<Trim>,
    /// How its seed and heading were chosen, if they were searched for.
    pub seeds: Option<Seeds>,
}

impl Findings {
    /// What is found of a net on its mold, with the target boundary and the search for its seed, if there are any.
    #[must_use]
    pub fn new(
        net: &Net,
        mold: &Mold,
        wanted: Option<&TargetBoundary>,
        seeds: Option<Seeds>,
    ) -> Self {
        let boundary = net.boundary(mold);
        let trim = boundary.as_ref().zip(wanted).and_then(|(own, wanted)| own.trim(mold, wanted));
        Findings { sharp_edges: net.sharp_edges(mold), boundary, trim, seeds }
    }
}
