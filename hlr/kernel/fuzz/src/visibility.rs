//! Checks the visibility pass on any scene: it terminates, does not depend on the number of threads and, for scenes
//! that keep the rules of the entry, agrees with the oracle on every interval.

use std::sync::OnceLock;

use hlr_visibility::scan::mesh::{DRAWN, Mesh};
use hlr_visibility::scan::own_faces::OwnFaces;
use hlr_visibility::scan::scene::{Group, Numbers, Scene as SceneInView, solve};
use hlr_visibility::scan::sweep::{Outcome, Steps};
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::bytes::Bytes;
use super::oracle::{self, HIDDEN, Shadow, WITHIN};
use super::scene::Scene;

/// Parameters are quotients of integers, rounded in two or three places.
const ROUNDING: f64 = 1e-13;

/// Radians to the line of sight, up to which a triangle counts as edge-on.
const EDGE_ON: f64 = 2e-5;

pub fn run(data: &[u8]) {
    check(&Scene::read(&mut Bytes::new(data)));
}

pub fn check(scene: &Scene) {
    let groups: Vec<Group> = (0..scene.cull.len())
        .map(|p| Group {
            cull: scene.cull[p],
            sound: scene.sound[p],
            delta: scene.delta[p],
            cap: scene.cap[p],
            tight: scene.tight[p],
        })
        .collect();
    let in_view = SceneInView {
        points: &scene.points,
        triangles: &scene.triangles,
        triangle_group: &scene.triangle_group,
        edges: &scene.edges,
        offsets: &scene.offsets,
        incident: &scene.incident,
        edge_group: &scene.edge_group,
        crossing: &[],
        role: &scene.role,
        groups: &groups,
    };
    let Some((mesh, grid)) = in_view.snapped() else { return };
    for p in &mesh.points {
        assert!(p[0].abs() < 1 << 30 && p[1].abs() < 1 << 30 && p[2].abs() <= 1 << 29, "off the grid: {p:?}");
    }
    let [one, two] = pools().each_ref().map(|pool| {
        pool.install(|| solve(&in_view, OwnFaces::NONE, Steps::ALL, Numbers::Exact, &|| false)).expect("an answer")
    });
    assert_eq!(listed(&one), listed(&two), "another answer on two threads");
    assert_eq!((&one.facing, format!("{:?}", one.counters)), (&two.facing, format!("{:?}", two.counters)));
    if scene.proper {
        assert_eq!(one.counters.contradictions, 0, "{:?}", one.counters);
        compare(&mesh, grid.scale_z / grid.scale_xy, &one);
    }
}

fn pools() -> &'static [ThreadPool; 2] {
    static POOLS: OnceLock<[ThreadPool; 2]> = OnceLock::new();
    POOLS.get_or_init(|| [1, 2].map(|n| ThreadPoolBuilder::new().num_threads(n).build().expect("threads")))
}

fn listed(outcome: &Outcome) -> Vec<(u32, u64, u64, u8)> {
    let row = |p: &hlr_visibility::scan::invisibility::Piece| {
        (p.edge, p.segment.start.to_bits(), p.segment.end.to_bits(), p.segment.state as u8)
    };
    outcome.pieces.iter().map(row).collect()
}

/// depth_scale: depth units of the grid per unit in the image.
fn compare(mesh: &Mesh, depth_scale: f64, outcome: &Outcome) {
    let corners = |t: usize| mesh.triangles[t].map(|v| mesh.points[v as usize]);
    let facing: Vec<i128> = (0..mesh.triangles.len()).map(|t| oracle::area(corners(t)).signum()).collect();
    assert!(outcome.facing.iter().zip(&facing).all(|(&a, &b)| i128::from(a) == b), "facing");
    let counted = |t: usize| facing[t] > 0 || (facing[t] < 0 && !mesh.groups[mesh.triangle_group[t] as usize].cull);
    let lied = unsound(mesh, &counted);
    // What the sweep finds is right by itself: the search polygon by polygon must not be what makes it so.
    assert!(outcome.counters.failed_checks == 0 || lied.contains(&true), "{:?}", outcome.counters);

    let mut pieces = outcome.pieces.iter().peekable();
    for e in 0..mesh.edges.len() {
        let mut found = Vec::new();
        while let Some(p) = pieces.next_if(|p| p.edge as usize == e) {
            // Diving, too, is within the tolerance.
            found.push((p.segment.start, p.segment.end, (p.segment.state as u8).min(oracle::WITHIN)));
        }
        let (group, around) = (mesh.edge_group[e], mesh.incident(e));
        let [a, b] = mesh.edges[e].map(|v| mesh.points[v as usize]);
        if !drawn(mesh, e, &counted) || a[..2] == b[..2] {
            assert!(found.is_empty(), "edge {e} is not to be drawn: {found:?}");
            continue;
        }
        // Rounding turns a needle any way: what is beside one is searched for.
        let needle = |t: usize| {
            let c = corners(t);
            let widths = [0, 1].map(|k| c.iter().map(|p| p[k]).max().unwrap() - c.iter().map(|p| p[k]).min().unwrap());
            oracle::area(c).abs() <= 2 * i128::from(widths[0].max(widths[1]))
        };
        let away = |&t: &i32| facing[t as usize] < 0 && !needle(t as usize);
        let turned = !around.is_empty() && around.iter().all(away);
        let mut slanted = Vec::new();
        let wanted = if mesh.groups[group as usize].cull && turned {
            vec![(0.0, 1.0, HIDDEN)]
        } else if lied[group as usize] {
            tiled(e, &found);
            continue;
        } else {
            let shadows = |delta: &dyn Fn(usize) -> i64| -> Vec<Shadow> {
                let counted = (0..facing.len()).filter(|&t| counted(t));
                counted.filter_map(|t| oracle::shadow(a, b, corners(t), delta(t))).collect()
            };
            let delta = |t: usize| delta(mesh, group, mesh.triangle_group[t]);
            let plain = shadows(&|_| 0);
            slanted = oracle::states(&plain, &shadows(&|t| at_a_slant(mesh, depth_scale, group, t, delta(t))));
            oracle::states(&plain, &shadows(&delta))
        };
        tiled(e, &found);
        agree(e, [a, b], &found, &wanted, &slanted);
    }
    assert!(pieces.next().is_none(), "pieces out of order");
}

/// A group told to be sound that is not: its own piercings are not looked for, and what they change is not promised.
fn unsound(mesh: &Mesh, counted: &dyn Fn(usize) -> bool) -> Vec<bool> {
    let pierces = |e: usize, t: usize| {
        let [a, b] = mesh.edges[e].map(|v| mesh.points[v as usize]);
        let corners = mesh.triangles[t].map(|v| mesh.points[v as usize]);
        oracle::shadow(a, b, corners, 0).is_some_and(|s| s.pierced)
    };
    let own = |group: i32| {
        (0..mesh.edges.len())
            .filter(move |&e| mesh.edge_group[e] == group)
            .any(|e| (0..mesh.triangles.len()).any(|t| mesh.triangle_group[t] == group && counted(t) && pierces(e, t)))
    };
    (0..mesh.groups.len()).map(|p| mesh.groups[p].sound && own(p as i32)).collect()
}

/// An outline is drawn where the number of faces in front changes across it, unless by one of several: that may be the end
/// of a layer.
fn drawn(mesh: &Mesh, e: usize, counted: &dyn Fn(usize) -> bool) -> bool {
    if mesh.role[e] & DRAWN != 0 || mesh.role[e] == 0 {
        return mesh.role[e] != 0;
    }
    let [a, b] = mesh.edges[e];
    let side = |&t: &i32| {
        let triangle = mesh.triangles[t as usize];
        let apex = triangle
            .iter()
            .find(|&&v| v != a && v != b)
            .map_or(0, |&v| oracle::area([a, b, v].map(|v| mesh.points[v as usize])).signum());
        if counted(t as usize) { apex } else { 0 }
    };
    ends_at(mesh.incident(e).iter().map(side)) || beside_strip(mesh, e) || behind_wall(mesh, e, counted)
}

/// sides: of each triangle at an edge on which side it lies, 1 or -1; 0 if it does not count.
fn ends_at(sides: impl Iterator<Item = i128>) -> bool {
    let sides: Vec<i128> = sides.filter(|&side| side != 0).collect();
    match sides[..] {
        [_] => true,
        _ => sides.iter().sum::<i128>().abs() > 1,
    }
}

/// So is the border of a wall, which is exactly edge-on, to what is turned away and not counted, unless other lines of the
/// wall cover it: of the triangles of its plane that hang together by edges that are no points in the image.
fn behind_wall(mesh: &Mesh, e: usize, counted: &dyn Fn(usize) -> bool) -> bool {
    let facing = |t: i32| oracle::area(mesh.triangles[t as usize].map(|v| mesh.points[v as usize])).signum();
    let ends = |e: usize| mesh.edges[e].map(|v| [0, 1].map(|k| mesh.points[v as usize][k]));
    let &[s, t] = mesh.incident(e) else { return false };
    let mut wall = match (facing(s), facing(t)) {
        (0, -1) => vec![s],
        (-1, 0) => vec![t],
        _ => return false,
    };
    let mut lines = Vec::new();
    let mut done = 0;
    while done < wall.len() {
        let own = wall[done];
        done += 1;
        for e in (0..mesh.edges.len()).filter(|&e| mesh.incident(e).contains(&own) && ends(e)[0] != ends(e)[1]) {
            let around = mesh.incident(e);
            let sides = around.iter().map(|&t| if counted(t as usize) { facing(t) * side_of(mesh, e, t) } else { 0 });
            if mesh.role[e] & DRAWN != 0 || (mesh.role[e] != 0 && ends_at(sides)) {
                lines.push(ends(e));
            }
            if let &[s, t] = around {
                let others = [s, t].into_iter().filter(|&t| facing(t) == 0 && !wall.contains(&t)).collect::<Vec<_>>();
                wall.extend(others);
            }
        }
    }
    // Between two neighbouring ends of lines, all of the edge is covered or nothing: its middle tells, doubled.
    let mut stops: Vec<[i32; 2]> = lines.iter().flatten().chain(&ends(e)).copied().collect();
    stops.sort_unstable();
    let twice = |p: [i32; 2]| p.map(|c| 2 * i64::from(c));
    let within = |line: &[[i32; 2]; 2], p: [i64; 2]| {
        let [a, b] = line.map(twice);
        a.min(b) < p && p < a.max(b)
    };
    stops.windows(2).filter(|w| w[0] != w[1]).any(|w| {
        let middle = [0, 1].map(|k| i64::from(w[0][k]) + i64::from(w[1][k]));
        within(&ends(e), middle) && !lines.iter().any(|line| within(line, middle))
    })
}

/// 1 where the triangle runs along an edge from its first end to its second, else -1.
fn side_of(mesh: &Mesh, e: usize, t: i32) -> i128 {
    let corners = mesh.triangles[t as usize];
    if (0..3).any(|k| [corners[k], corners[(k + 1) % 3]] == mesh.edges[e]) { 1 } else { -1 }
}

/// So are the borders of a strip that is edge-on but for the rounding of its file: between two triangles that face the
/// same way, only one of which is such a strip.
fn beside_strip(mesh: &Mesh, e: usize) -> bool {
    let &[s, t] = mesh.incident(e) else { return false };
    let corners = |t: i32| mesh.triangles[t as usize].map(|v| mesh.points[v as usize]);
    let strip = |t: i32| {
        let [x, y, z] = oracle::normal(corners(t)).map(|c| c as f64);
        z.abs() <= EDGE_ON * (x * x + y * y).sqrt()
    };
    strip(s) != strip(t) && oracle::area(corners(s)).signum() == oracle::area(corners(t)).signum()
}

/// How far an edge is moved before it is compared with a group.
fn delta(mesh: &Mesh, own: i32, other: i32) -> i64 {
    let (a, b) = (&mesh.groups[own as usize], &mesh.groups[other as usize]);
    match own == other {
        true if a.sound || a.cull => 0,
        true => a.delta,
        false if a.tight => a.delta.min(b.cap),
        false => a.delta.max(b.delta).min(b.cap),
    }
}

/// The most that an edge may be moved before it is compared with a triangle of another group, seen at a slant: four fifths
/// of what it is moved for its group, over |N . v|. Rounded up.
fn at_a_slant(mesh: &Mesh, depth_scale: f64, own: i32, t: usize, delta: i64) -> i64 {
    let group = mesh.triangle_group[t];
    if delta == 0 || group == own {
        return delta;
    }
    let [x, y, z] = oracle::normal(mesh.triangles[t].map(|v| mesh.points[v as usize])).map(|c| c as f64);
    let across = (x * x + y * y) / (depth_scale * depth_scale);
    let facing = z.abs() / (across + z * z).sqrt();
    ((delta as f64 * 0.8 / facing.max(0.005)) as i64 + 1).min(mesh.groups[group as usize].cap).max(delta)
}

type Interval = (f64, f64, u8);

/// Pieces ascend from 0 to 1; only what is shorter than rounding may be missing between.
fn tiled(e: usize, found: &[Interval]) {
    let mut at = 0.0;
    for &(from, to, _) in found {
        assert!((from - at).abs() < ROUNDING && to > from, "edge {e}: {found:?}");
        at = to;
    }
    assert!(at > 1.0 - ROUNDING, "edge {e}: {found:?}");
}

/// The same state wherever either side cuts the edge, but for slivers of rounding. What is hidden may touch, where it does
/// so at a slant.
fn agree(e: usize, ends: [oracle::Point; 2], found: &[Interval], wanted: &[Interval], slanted: &[Interval]) {
    let mut cuts: Vec<f64> = found.iter().chain(wanted).chain(slanted).flat_map(|&(from, to, _)| [from, to]).collect();
    cuts.sort_unstable_by(f64::total_cmp);
    for w in cuts.windows(2).filter(|w| w[1] - w[0] > ROUNDING) {
        let middle = 0.5 * (w[0] + w[1]);
        let at = |list: &[Interval]| list.iter().find(|i| i.0 < middle && middle < i.1).map(|i| i.2);
        if (at(found), at(wanted), at(slanted)) == (Some(WITHIN), Some(HIDDEN), Some(WITHIN)) {
            continue;
        }
        assert_eq!(at(found), at(wanted), "edge {e} {ends:?} at {middle}: kernel {found:?}, oracle {wanted:?}");
    }
}
