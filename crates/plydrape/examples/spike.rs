use plydrape::equilibrium::Solver;
use std::path::Path;
fn main(){
 let scene=plydrape::scene::read(Path::new("examples/01_flat_sheared_mold/scene.toml")).unwrap();
 let laid=vec![None;16];
 let mut s=Solver::new(&scene.ply,&scene.settings);
 for k in [0,1,0,1,2,3,4,5,9,10,9] { let o=s.solve(&scene.motion.positions[k],&laid); println!("{k} {o:?} joints {}", s.slopes().len()); 
 let n=3000; 
 if k<2 || k>8 { let t=std::time::Instant::now(); for _ in 0..n { s.solve(&scene.motion.positions[k],&laid); } println!("   same again {:.1} us", t.elapsed().as_micros() as f64/n as f64);
 let t=std::time::Instant::now(); for _ in 0..n { s.forget(); s.solve(&scene.motion.positions[k],&laid); } println!("   cold {:.1} us", t.elapsed().as_micros() as f64/n as f64);
 let j= if k<2 {1-k} else {19-k}; let t=std::time::Instant::now(); for i in 0..n { s.solve(&scene.motion.positions[if i%2==0 {j} else {k}],&laid); } println!("   warm {:.1} us", t.elapsed().as_micros() as f64/n as f64);}
 }
}
