use super::*;
use plydrape::mold::{Face, Pose, Sphere};
use plydrape::net::{EdgeRule, Generators, Net, Placement};

/// A bowl's worth of fabric over a hemisphere, some of it beyond the equator.
fn ball() -> Mold {
    let pose = Pose::new([0.0, 0.0, 0.0], [0.0; 3]);
    Mold::Sphere(Sphere { pose, radius: 0.1, face: Face::Outside })
}

fn bowl() -> Mold {
    let pose = Pose::new([0.0, 0.0, 0.2], [0.0; 3]);
    Mold::Sphere(Sphere { pose, radius: 0.2, face: Face::Inside })
}

fn draped(mold: &Mold, count: usize, mesh: f64, place: [f64; 3]) -> Net {
    let layup = Placement {
        nodes: [count, count],
        mesh: [mesh; 2],
        origin: [0.0; 2],
        seed: [count / 2; 2],
        place,
        heading: 0.3,
        shear: 0.0,
        generators: Generators::Geodesic,
        edges: EdgeRule::Along,
    };
    Net::drape(mold, layup).unwrap()
}

/// Many cells on a dome, none missing; and a ply that is larger than its bowl.
fn nets() -> [(Mold, Net); 2] {
    let (dome, open) = (ball(), bowl());
    let whole = draped(&dome, 41, 0.005, [0.0, 0.0, 0.1]);
    let large = draped(&open, 61, 0.012, [0.0; 3]);
    [(dome, whole), (open, large)]
}

fn rows(text: &str) -> Vec<Vec<String>> {
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    reader.records().map(|r| r.unwrap().iter().map(str::to_owned).collect()).collect()
}

/// Every node has its row; places read back to the same bits, a missing node has none.
#[test]
fn the_table_of_nodes_reads_back_and_leaves_missing_ones_empty() {
    let (_, net) = &nets()[1];
    assert!(net.report.off_mold > 0 && net.report.placed > 100);
    let text = nodes::table(net).unwrap();
    assert_eq!(text.lines().next(), Some("i,j,u,v,x,y,z,shear_deg,on_ply"));
    let rows = rows(&text);
    assert_eq!(rows.len(), net.nodes.len());
    for (n, row) in rows.iter().enumerate() {
        let id = [n % 61, n / 61];
        assert_eq!([&row[0], &row[1]], [&id[0].to_string(), &id[1].to_string()]);
        match net.node(id) {
            Some(place) => {
                let read: Vec<f64> = (4..7).map(|k| row[k].parse().unwrap()).collect();
                assert_eq!(read, place);
            }
            None => assert!(row[4..8].iter().all(String::is_empty)),
        }
    }
}

/// A node's shear is the mean of the cells that meet in it.
#[test]
fn shear_at_a_node_is_the_mean_of_its_cells() {
    let (_, net) = &nets()[0];
    let cell = |i, j| net.cell_shear([i, j]).unwrap().magnitude;
    let inner = (cell(4, 7) + cell(5, 7) + cell(4, 8) + cell(5, 8)) / 4.0;
    assert!((nodal_shear(net, [5, 8]).unwrap() - inner).abs() < 1e-15);
    assert_eq!(nodal_shear(net, [0, 0]), Some(cell(0, 0)));
}

/// A net of one line has no cells and so no map; it has its nodes, its lines and its mold.
#[test]
fn a_line_of_nodes_has_no_map() {
    let mold = ball();
    let mut layup = nets()[0].1.placement;
    (layup.nodes, layup.seed) = ([20, 1], [10, 0]);
    let net = Net::drape(&mold, layup).unwrap();
    assert_eq!(figure::shear_map::svg(&net, "line"), None);
    let home = tempfile::tempdir().unwrap();
    assert_eq!(
        write_all(&net, &mold, &Findings::default(), "line", home.path(), &[]).unwrap().len(),
        3
    );
}

/// Files, and the same bytes again from the same net.
#[test]
fn a_net_writes_its_files_twice_the_same() {
    let dir = tempfile::tempdir().unwrap();
    let (mold, net) = &nets()[0];
    let findings = Findings::new(net, mold, None, None);
    let paths = write_all(net, mold, &findings, "dome", dir.path(), &[]).unwrap();
    let names: Vec<_> = paths.iter().filter_map(|p| p.file_name()).collect();
    assert_eq!(
        names,
        ["nodes.csv", "boundary.csv", "boundary.dxf", "shear.svg", "net.vtp", "mold.vtp"]
    );
    let read = || -> Vec<Vec<u8>> { paths.iter().map(|p| std::fs::read(p).unwrap()).collect() };
    let first = read();
    write_all(net, mold, &findings, "dome", dir.path(), &[]).unwrap();
    assert_eq!(read(), first);
}

/// A net is accepted if every node has its place and no cell shears beyond the limit; the verdict says
/// what is not so.
#[test]
fn a_net_is_refused_beyond_its_shear_limit_and_beyond_its_mold() {
    let [(_, whole), (bowl, large)] = &nets();
    let none = Findings::default();
    let (largest, cell) = whole.report.largest_shear.unwrap();
    let free = Summary::new(whole, &none, None);
    assert!(free.accepted && free.table().ends_with("\naccepted\n"), "{}", free.table());
    assert_eq!(free.max_shear_at.unwrap().cell, cell);
    assert!(Summary::new(whole, &none, Some(largest)).accepted);
    let tight = Summary::new(whole, &none, Some(0.5 * largest));
    assert!(!tight.accepted);
    assert!(tight.verdict().starts_with("not accepted: shear 5"), "{}", tight.verdict());
    let beyond = Summary::new(large, &Findings::new(large, bowl, None, None), None);
    assert!(!beyond.accepted && beyond.verdict().contains("beyond the mold's boundary"));
    assert!(beyond.table().lines().all(|l| l.chars().count() <= 100), "{}", beyond.table());
}
