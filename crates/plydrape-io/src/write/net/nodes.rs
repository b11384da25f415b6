//! The table `nodes.csv`: where every node of the net lies; lengths in meters, shear in degrees.
//!
//! Numbers are in the shortest form that reads back to the same double. A node without a place on the mold
//! has empty cells for what is not known.

use super::nodal_shear;
use crate::Error;
use crate::write::csv::{number, text};
use ::csv::Writer;
use plydrape::net::Net;

/// One row a node, i running fastest: grid indices, fabric coordinates, place, shear: the mean over the whole cells around the
/// node of their shear magnitude, and 1 where the node is on the ply, 0 beside one that is cut.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn table(net: &Net) -> Result<String, Error> {
    let mut table = Writer::from_writer(Vec::new());
    table.write_record(["i", "j", "u", "v", "x", "y", "z", "shear_deg", "on_ply"])?;
    let [nu, nv] = net.placement.nodes;
    let coverage = net.coverage();
    for id in (0..nu * nv).map(|n| [n % nu, n / nu]) {
        let mut row = vec![id[0].to_string(), id[1].to_string()];
        row.extend(net.placement.fabric(id).map(number));
        match net.node(id) {
            Some(place) => row.extend(place.map(number)),
            None => row.extend(["", "", ""].map(str::to_owned)),
        }
        let shear = net.node(id).and_then(|_| nodal_shear(net, id));
        row.push(shear.map(|s| number(s.to_degrees())).unwrap_or_default());
        row.push(u8::from(coverage.node(id)).to_string());
        table.write_record(&row)?;
    }
    text(table)
}
