//! Stand-in.
use super::Mold;
/// T
pub struct Triangles { /// v
  pub vertices: Vec<[f64;3]>, /// t
  pub triangles: Vec<[u32;3]> }
/// p
pub fn patch(mold:&Mold, low:[f64;2], high:[f64;2], most: usize)->Triangles{
  let n=((most/2) as f64).sqrt() as u32; let mut t=Triangles{vertices:vec![],triangles:vec![]};
  let mut ok=vec![];
  for j in 0..=n { for i in 0..=n {
    let p=mold.drop_to([low[0]+(high[0]-low[0])*i as f64/n as f64, low[1]+(high[1]-low[1])*j as f64/n as f64]);
    ok.push(p.is_some()); t.vertices.push(p.unwrap_or([0.0;3])); }}
  for j in 0..n { for i in 0..n { let a=j*(n+1)+i; let q=[a,a+1,a+n+2,a+n+1];
    if q.iter().all(|k| ok[*k as usize]) { t.triangles.push([q[0],q[1],q[2]]); t.triangles.push([q[0],q[2],q[3]]); } }}
  t
}
