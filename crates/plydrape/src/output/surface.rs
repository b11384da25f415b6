//! Stand-in.
use super::figure::cells;
use crate::draping::record::ResultFile;
/// Surface.
pub struct Surface { /// v
    pub vertices: Vec<[f64;3]> }
impl Surface {
    /// n
    pub fn new(result: &ResultFile, step: usize, n: usize) -> Self {
        let grid = result.scene.grid;
        let w = (grid.nu-1)*n+1; let h=(grid.nv-1)*n+1;
        let mut vertices = vec![[0.0;3]; w*h];
        for (id, points) in cells(grid, &result.steps[step], n) {
            for (k,p) in points.iter().enumerate() {
                let (s,t)=(k%(n+1),k/(n+1));
                vertices[(id[1]*n+t)*w+id[0]*n+s]=*p;
            }
        }
        Surface { vertices }
    }
}
