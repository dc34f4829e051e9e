//! Checks the intersection segments of any triangles: they lie on both, do not depend on the number of threads, and for
//! small coordinates equal an exact computation.

use std::cmp::Ordering;
use std::sync::OnceLock;

use hlr_exact::snap::Grid;
use hlr_visibility::clash::planar_faces::{NO_PLANE, PlanarFaces};
use hlr_visibility::clash::search::Clash;
use hlr_visibility::clash::surfaces::Surfaces;
use hlr_visibility::clash::triangle_pair::{Numbered, meet};
use hlr_visibility::clash::weld::weld;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::bytes::{Bytes, Numbers};
use super::oracle::{Fraction, Point, compare};

const MOST_PLACES: usize = 12;
const MOST_TRIANGLES: usize = 40;
/// Small coordinates are multiples of this many units, so that rounding is far below their distances.
const STEP: i32 = 1 << 22;
/// Rounding moves each coordinate by half a unit; quotients are off by far less.
const UNIT: f64 = 0.87;

struct Case {
    points: Vec<Point>,
    triangles: Vec<[i32; 3]>,
    group: Vec<i32>,
    itself: Vec<bool>,
    /// Before they were multiplied by `STEP`.
    small: Option<Vec<Point>>,
}

pub fn run(data: &[u8]) {
    if let Some(case) = Case::read(&mut Bytes::new(data)) {
        check(&case);
    }
}

impl Case {
    fn read(bytes: &mut Bytes) -> Option<Case> {
        let proper = !bytes.byte().is_multiple_of(8);
        let kind = bytes.numbers();
        let (places, groups) = (1 + bytes.below(MOST_PLACES), 1 + bytes.below(4));
        let exact: Vec<[f64; 3]> = (0..places).map(|_| [0; 3].map(|_| bytes.number(kind))).collect();
        let small = matches!(kind, Numbers::Few | Numbers::Small);
        // Each group has vertices of its own, in the same places.
        let small = small.then(|| exact.repeat(groups).iter().map(|p| p.map(|c| c as i32)).collect::<Vec<Point>>());
        let points = match &small {
            Some(small) => small.iter().map(|p| p.map(|c| c * STEP)).collect(),
            None => {
                let grid = Grid::uniform_around(&exact)?;
                exact.repeat(groups).iter().map(|p| grid.snap(p)).collect()
            }
        };
        let itself = (0..groups).map(|_| bytes.bit()).collect();
        let (mut triangles, mut group) = (Vec::new(), Vec::new());
        for _ in 0..bytes.below(MOST_TRIANGLES + 1) {
            let own = bytes.below(groups);
            let of = if proper { own } else { bytes.below(groups) };
            triangles.push([0; 3].map(|_: i32| (of * places + bytes.below(places)) as i32));
            group.push(own as i32);
        }
        Some(Case { points, triangles, group, itself, small })
    }

    fn found(&self, pool: &ThreadPool, group: &[i32], itself: &[bool]) -> Vec<Clash> {
        let planar = PlanarFaces::without_neighbours(vec![NO_PLANE; self.triangles.len()]);
        let surfaces = Surfaces { points: &self.points, triangles: &self.triangles, group, itself, planar: &planar };
        pool.install(|| surfaces.clashes(&|| false)).found
    }

    fn corners(&self, t: usize) -> [Point; 3] {
        self.triangles[t].map(|v| self.points[v as usize])
    }
}

fn check(case: &Case) {
    let found = case.found(&pools()[0], &case.group, &case.itself);
    assert_eq!(listed(&found), listed(&case.found(&pools()[1], &case.group, &case.itself)), "another on two threads");
    let key = |c: &Clash| (c.triangles.map(|t| case.group[t as usize]), c.triangles);
    assert!(found.windows(2).all(|w| key(&w[0]) < key(&w[1])), "not in order");

    // Groups numbered backwards: the same segments, found the other way round.
    let last = case.itself.len() as i32 - 1;
    let group: Vec<i32> = case.group.iter().map(|g| last - g).collect();
    let itself: Vec<bool> = case.itself.iter().rev().copied().collect();
    assert_eq!(sorted(&found), sorted(&case.found(&pools()[0], &group, &itself)), "another for groups swapped");

    for clash in &found {
        on_both(case, clash);
    }
    complete(case, &found);
    let (points, edges) = weld(&found);
    assert!(points.windows(2).all(|w| w[0] < w[1]), "welded twice");
    for (clash, edge) in found.iter().zip(&edges) {
        assert_eq!(edge.map(|v| points[v as usize]), clash.meeting.ends);
    }
}

fn pools() -> &'static [ThreadPool; 2] {
    static POOLS: OnceLock<[ThreadPool; 2]> = OnceLock::new();
    POOLS.get_or_init(|| [1, 2].map(|n| ThreadPoolBuilder::new().num_threads(n).build().expect("threads")))
}

type Row = ([u32; 2], [Point; 2], u64, u64);

fn listed(found: &[Clash]) -> Vec<Row> {
    found.iter().map(|c| (c.triangles, c.meeting.ends, c.meeting.depth.to_bits(), c.meeting.sine.to_bits())).collect()
}

fn sorted(found: &[Clash]) -> Vec<Row> {
    let mut rows = listed(found);
    rows.iter_mut().for_each(|row| row.0.sort_unstable());
    rows.sort_unstable();
    rows
}

fn on_both(case: &Case, clash: &Clash) {
    let meeting = &clash.meeting;
    assert!(meeting.ends[0] < meeting.ends[1] && meeting.depth >= 0.0, "{meeting:?}");
    assert!((0.0..=1.0 + 1e-9).contains(&meeting.sine), "{meeting:?}");
    for t in clash.triangles {
        let corners = case.corners(t as usize);
        let n = normal(corners);
        let length = n.iter().map(|&c| (c as f64).powi(2)).sum::<f64>().sqrt();
        for end in meeting.ends {
            let off = dot(n, minus(end, corners[0])).abs() as f64;
            assert!(off <= UNIT * length, "{end:?} is {} units off the plane of {corners:?}", off / length);
            for k in 0..3 {
                let (low, high) = corners.iter().fold((i32::MAX, i32::MIN), |(l, h), p| (l.min(p[k]), h.max(p[k])));
                assert!((low - 1..=high + 1).contains(&end[k]), "{end:?} is outside {corners:?}");
            }
        }
    }
}

/// All pairs that are to be tried have been; those of small coordinates, as the oracle says.
fn complete(case: &Case, found: &[Clash]) {
    let count = case.triangles.len();
    for t in 0..count {
        for u in t + 1..count {
            let (g, h) = (case.group[t], case.group[u]);
            let shared = case.triangles[t].iter().filter(|v| case.triangles[u].contains(v)).count();
            let tried = if g == h { case.itself[g as usize] && shared < 2 } else { true };
            let pair = [t as u32, u as u32];
            let said = found.iter().find(|c| c.triangles == pair || c.triangles == [pair[1], pair[0]]);
            assert!(tried || said.is_none(), "{pair:?} are not to be tried");
            if !tried {
                continue;
            }
            let numbered = |t: usize| Numbered {
                corner: case.triangles[t].map(|v| &case.points[v as usize]),
                number: case.triangles[t],
            };
            let (one, other) = (meet(&numbered(t), &numbered(u)), meet(&numbered(u), &numbered(t)));
            assert_eq!(one, other, "another for triangles {pair:?} swapped");
            let deep = one.is_some_and(|m| m.depth > 0.0);
            assert!(said.is_some() || !deep, "{pair:?} not found");
            assert!(said.is_none_or(|c| Some(c.meeting) == one), "{pair:?} found otherwise");
            if let Some(small) = &case.small {
                let wanted = common([t, u].map(|t| case.triangles[t].map(|v| small[v as usize])));
                as_wanted(one.filter(|m| m.depth > 0.0).map(|m| m.ends), wanted, pair);
            }
        }
    }
}

fn as_wanted(said: Option<[Point; 2]>, wanted: Option<[[f64; 3]; 2]>, pair: [u32; 2]) {
    let Some(wanted) = wanted else {
        assert!(said.is_none(), "{pair:?} do not meet");
        return;
    };
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() <= 0.51);
    let Some(said) = said else {
        let reach = (0..3).map(|k| (wanted[0][k] - wanted[1][k]).abs()).fold(0.0, f64::max);
        assert!(reach < 2.0, "{pair:?} meet in {wanted:?}");
        return;
    };
    let [p, q] = said.map(|end| end.map(f64::from));
    let [a, b] = wanted;
    assert!((near(p, a) && near(q, b)) || (near(p, b) && near(q, a)), "{pair:?}: {said:?}, not {wanted:?}");
}

/// The common segment of two triangles that strictly part one another's planes, in grid units: each triangle cuts the
/// planes' common line in an interval, and the segment is what the intervals share.
fn common(pair: [[Point; 3]; 2]) -> Option<[[f64; 3]; 2]> {
    let normals = pair.map(normal);
    let along = cross(normals[0], normals[1]);
    let mut cuts: [Vec<(Fraction, [f64; 3])>; 2] = [Vec::new(), Vec::new()];
    for (k, cut) in cuts.iter_mut().enumerate() {
        let (own, other) = (pair[k], 1 - k);
        let side = own.map(|p| dot(normals[other], minus(p, pair[other][0])));
        if !(side.iter().any(|&s| s < 0) && side.iter().any(|&s| s > 0)) {
            return None;
        }
        for i in 0..3 {
            for j in 0..3 {
                if side[i] >= 0 && side[j] < 0 {
                    let (whole, p, q) = (side[i] - side[j], own[i], own[j]);
                    let at = [0, 1, 2].map(|c| i128::from(q[c]) * side[i] - i128::from(p[c]) * side[j]);
                    let place = at.map(|c| c as f64 / whole as f64 * f64::from(STEP));
                    cut.push(((dot(along, at), whole), place));
                }
            }
        }
        cut.sort_by(|a, b| compare(a.0, b.0));
    }
    let later = |a: (Fraction, [f64; 3]), b: (Fraction, [f64; 3])| if compare(a.0, b.0).is_lt() { b } else { a };
    let earlier = |a: (Fraction, [f64; 3]), b: (Fraction, [f64; 3])| if compare(a.0, b.0).is_gt() { b } else { a };
    let [a, b] = cuts;
    let (from, to) = (later(a[0], b[0]), earlier(*a.last()?, *b.last()?));
    (compare(from.0, to.0) == Ordering::Less).then_some([from.1, to.1])
}

fn minus(a: Point, b: Point) -> [i128; 3] {
    [0, 1, 2].map(|k| i128::from(a[k]) - i128::from(b[k]))
}

fn cross(u: [i128; 3], v: [i128; 3]) -> [i128; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn dot(u: [i128; 3], v: [i128; 3]) -> i128 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

fn normal([p, q, r]: [Point; 3]) -> [i128; 3] {
    cross(minus(q, p), minus(r, p))
}
