//! Checks edges, fans, folds and components of any triangles against plain nested loops.

use hlr_linework::lines::chain::chain;
use hlr_mesh::topology::{balance, components, folds, normals, topology};

use super::bytes::Bytes;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let kind = bytes.numbers();
    let places = 1 + bytes.below(40);
    let points: Vec<[f64; 3]> = (0..places).map(|_| [0; 3].map(|_| bytes.number(kind))).collect();
    let triangles: Vec<[i32; 3]> =
        (0..bytes.below(120)).map(|_| [0; 3].map(|_: i32| bytes.below(places) as i32)).collect();
    let wires: Vec<[i32; 2]> = (0..bytes.below(20)).map(|_| [0; 2].map(|_: i32| bytes.below(places) as i32)).collect();

    let table = topology(&triangles, places);
    check_edges(&triangles, places as i32, &table.edges, &table.offsets, &table.incident);
    let sums = balance(&triangles, &table.edges, &table.offsets, &table.incident);
    check_balance(&triangles, &table.edges, &sums);
    let unit = normals(&points, &triangles);
    for n in &unit {
        let square: f64 = n.iter().map(|c| c * c).sum();
        // Coordinates whose squares overflow have no normal; none of the entry's do.
        assert!(square == 0.0 || (square - 1.0).abs() < 1e-9 || !sane(&points), "{n:?}");
    }
    for (e, &fold) in folds(&unit, &table.offsets, &table.incident, &sums).iter().enumerate() {
        let two = table.offsets[e + 1] - table.offsets[e] == 2;
        let cosine = fold.abs() <= 1.0 + 1e-9 || !sane(&points);
        assert!(fold.is_nan() || (two && cosine), "edge {e} folds by {fold}");
    }
    check_components(&triangles, places);
    check_components(&wires, places);
    let key: Vec<i32> = wires.iter().map(|_| bytes.below(3) as i32).collect();
    check_chains(&wires, &key);
    check_chains(&table.edges, &vec![0; table.edges.len()]);
}

fn sane(points: &[[f64; 3]]) -> bool {
    points.iter().flatten().all(|c| *c == 0.0 || (1e-60..1e60).contains(&c.abs()))
}

fn check_edges(triangles: &[[i32; 3]], places: i32, edges: &[[i32; 2]], offsets: &[i32], incident: &[i32]) {
    let mut wanted = Vec::new();
    for low in 0..places {
        for high in low + 1..places {
            let sides = |t: &[i32; 3]| {
                (0..3)
                    .filter(|&k| [t[k], t[(k + 1) % 3]] == [low, high] || [t[(k + 1) % 3], t[k]] == [low, high])
                    .count()
            };
            let fan: Vec<i32> =
                (0..triangles.len()).flat_map(|t| std::iter::repeat_n(t as i32, sides(&triangles[t]))).collect();
            if !fan.is_empty() {
                wanted.push(([low, high], fan));
            }
        }
    }
    assert_eq!(offsets.len(), edges.len() + 1);
    let found: Vec<([i32; 2], Vec<i32>)> =
        (0..edges.len()).map(|e| (edges[e], incident[offsets[e] as usize..offsets[e + 1] as usize].to_vec())).collect();
    assert_eq!(found, wanted);
}

/// Along minus against. A triangle with a repeated corner runs along its edge both ways; it has no side to be on.
fn check_balance(triangles: &[[i32; 3]], edges: &[[i32; 2]], sums: &[i32]) {
    for (&[low, high], &sum) in edges.iter().zip(sums) {
        let mut wanted = 0;
        for t in triangles.iter().filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
            for k in 0..3 {
                wanted +=
                    i32::from([t[k], t[(k + 1) % 3]] == [low, high]) - i32::from([t[(k + 1) % 3], t[k]] == [low, high]);
            }
        }
        let folded = triangles
            .iter()
            .any(|t| (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) && t.contains(&low) && t.contains(&high));
        assert!(folded || sum == wanted, "edge {low}-{high}: {sum}, not {wanted}");
    }
}

fn check_components<const N: usize>(cells: &[[i32; N]], places: usize) {
    let labels = components(cells, places);
    // Spread labels from cell to cell until nothing changes.
    let mut wanted: Vec<usize> = (0..cells.len()).collect();
    let mut changed = true;
    while changed {
        changed = false;
        for i in 0..cells.len() {
            for j in 0..i {
                if wanted[i] != wanted[j] && cells[i].iter().any(|v| cells[j].contains(v)) {
                    let least = wanted[i].min(wanted[j]);
                    (wanted[i], wanted[j], changed) = (least, least, true);
                }
            }
        }
    }
    let mut order: Vec<usize> = Vec::new();
    for w in &wanted {
        if !order.contains(w) {
            order.push(*w);
        }
    }
    let numbered: Vec<i32> =
        wanted.iter().map(|w| order.iter().position(|o| o == w).map_or(-1, |i| i as i32)).collect();
    assert_eq!(labels, numbered);
}

/// Every edge once; neighbours in a chain meet, have one key, and chains end only where they must.
pub fn check_chains(edges: &[[i32; 2]], key: &[i32]) {
    let chains = chain(edges, key, None);
    let mut all = chains.order.clone();
    all.sort_unstable();
    assert!(all.iter().copied().eq(0..edges.len() as i32), "each edge once: {:?}", chains.order);
    assert_eq!(chains.reversed.len(), edges.len());
    assert_eq!((chains.offsets[0], chains.offsets[chains.offsets.len() - 1]), (0, edges.len() as i32));
    let ends = |i: usize| {
        let [a, b] = edges[chains.order[i] as usize];
        if chains.reversed[i] { (b, a) } else { (a, b) }
    };
    let degree = |k: i32, v: i32| {
        edges
            .iter()
            .zip(key)
            .filter(|(_, o)| **o == k)
            .map(|(e, _)| e.iter().filter(|w| **w == v).count())
            .sum::<usize>()
    };
    for w in chains.offsets.windows(2) {
        let (first, last) = (w[0] as usize, w[1] as usize - 1);
        assert!(first <= last, "an empty chain");
        for i in first..last {
            let k = key[chains.order[i] as usize];
            assert_eq!((ends(i).1, k), (ends(i + 1).0, key[chains.order[i + 1] as usize]));
            assert_eq!(degree(k, ends(i).1), 2, "a chain goes on through a fork");
        }
        let (start, end, k) = (ends(first).0, ends(last).1, key[chains.order[first] as usize]);
        for v in [start, end] {
            let closed = start == end;
            assert!(closed || degree(k, v) != 2, "a chain ends at {v}, where another goes on");
        }
    }
}
