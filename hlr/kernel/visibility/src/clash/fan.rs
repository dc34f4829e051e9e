//! Vertices around which a surface lies flat: seen from one side, its triangles there lie side by side, once around.
//!
//! ```text
//!       \   |   /        Two that have nothing but this vertex in common meet in it alone: most pairs of triangles whose
//!        \  |  /         boxes overlap are such neighbours, and need not be looked at.
//!     ----- v -----
//!        /  |  \
//! ```

use rayon::prelude::*;

use super::search::Surfaces;
use hlr_exact::Point;

/// Of the product of two sides' lengths: what a triangle must be seen wide at least, far above what rounding may hide.
const WIDE: f64 = 1e-9;
/// Triangles around a vertex, at most: their order takes time as the square of it.
const MOST: usize = 1000;

type Vec3 = [f64; 3];

/// A triangle at the vertex: the vertices that follow, and the ways there.
#[derive(Clone, Copy)]
struct Sector {
    from: i32,
    to: i32,
    ways: [Vec3; 2],
}

/// Per point, whether its triangles lie flat around it, all of one group that is searched against itself.
pub fn flat_vertices(surfaces: &Surfaces) -> Vec<bool> {
    let searched = |t: usize| surfaces.itself[surfaces.group[t] as usize];
    let mut first = vec![0u32; surfaces.points.len() + 1];
    for (t, corners) in surfaces.triangles.iter().enumerate() {
        if searched(t) {
            corners.iter().for_each(|&v| first[v as usize + 1] += 1);
        }
    }
    for v in 1..first.len() {
        first[v] += first[v - 1];
    }
    let mut around = vec![0u32; first[first.len() - 1] as usize];
    let mut next = first.clone();
    for (t, corners) in surfaces.triangles.iter().enumerate() {
        if searched(t) {
            for &v in corners {
                around[next[v as usize] as usize] = t as u32;
                next[v as usize] += 1;
            }
        }
    }
    drop(next);
    (0..surfaces.points.len())
        .into_par_iter()
        .with_min_len(1 << 10)
        .map_init(Vec::new, |sectors, v| {
            let around = &around[first[v] as usize..first[v + 1] as usize];
            gather(surfaces, v as i32, around, sectors) && closed(sectors) && once_around(sectors)
        })
        .collect()
}

/// The triangles around a vertex; false where one has no other corners or is of another group than the first.
fn gather(surfaces: &Surfaces, v: i32, around: &[u32], sectors: &mut Vec<Sector>) -> bool {
    if around.len() < 3 || around.len() > MOST {
        return false;
    }
    let here = &surfaces.points[v as usize];
    let group = surfaces.group[around[0] as usize];
    sectors.clear();
    for &t in around {
        let [a, b, c] = surfaces.triangles[t as usize];
        let (from, to) = if a == v {
            (b, c)
        } else if b == v {
            (c, a)
        } else {
            (a, b)
        };
        if from == v || to == v || surfaces.group[t as usize] != group {
            return false;
        }
        let way = |to: i32| way(here, &surfaces.points[to as usize]);
        sectors.push(Sector { from, to, ways: [way(from), way(to)] });
    }
    true
}

/// Puts the sectors in order, each beginning where the last one ended; false where they do not close.
fn closed(sectors: &mut [Sector]) -> bool {
    for i in 1..sectors.len() {
        let end = sectors[i - 1].to;
        let Some(k) = (i..sectors.len()).find(|&k| sectors[k].from == end) else { return false };
        sectors.swap(i, k);
    }
    sectors[sectors.len() - 1].to == sectors[0].from
}

/// Whether all sectors turn the same way, seen along one direction, and make one turn together.
fn once_around(sectors: &[Sector]) -> bool {
    let mut along = [0.0; 3];
    for Sector { ways: [a, b], .. } in sectors {
        let (n, size) = (cross(a, b), (dot(a, a) * dot(b, b)).sqrt());
        if size == 0.0 {
            return false;
        }
        for k in 0..3 {
            along[k] += n[k] / size;
        }
    }
    let seen = |a: &Vec3, b: &Vec3| dot(&cross(a, b), &along);
    let wide = |Sector { ways: [a, b], .. }: &Sector| seen(a, b) > WIDE * (dot(a, a) * dot(b, b)).sqrt();
    // How often the way to the first corner is passed, itself included: sectors are wide, so rounding decides nothing.
    let ray = &sectors[0].ways[0];
    let passes = sectors.iter().filter(|s| seen(&s.ways[0], ray) >= 0.0 && seen(ray, &s.ways[1]) > 0.0).count();
    passes == 1 && sectors.iter().all(wide)
}

fn way(from: &Point, to: &Point) -> Vec3 {
    [
        f64::from(to[0]) - f64::from(from[0]),
        f64::from(to[1]) - f64::from(from[1]),
        f64::from(to[2]) - f64::from(from[2]),
    ]
}

fn dot(a: &Vec3, b: &Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Vec3, b: &Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of `count` triangles around point 0, `turns` times around; heights of the corners by their number.
    fn fan(count: usize, turns: usize, height: impl Fn(usize) -> i32) -> (Vec<Point>, Vec<[i32; 3]>) {
        let mut points = vec![[0; 3]];
        for k in 0..count {
            let angle = (k * turns) as f64 * std::f64::consts::TAU / count as f64;
            points.push([(1e6 * angle.cos()) as i32, (1e6 * angle.sin()) as i32, height(k)]);
        }
        let triangles = (0..count).map(|k| [0, 1 + k as i32, 1 + ((k + 1) % count) as i32]).collect();
        (points, triangles)
    }

    fn told((points, triangles): &(Vec<Point>, Vec<[i32; 3]>), group: &[i32], itself: &[bool]) -> bool {
        flat_vertices(&Surfaces { points, triangles, group, itself, plane: &[] })[0]
    }

    #[test]
    fn tips_and_saddles_lie_flat_and_what_winds_twice_does_not() {
        let one = |shape| told(&shape, &[0; 12], &[true]);
        assert!(one(fan(12, 1, |_| 0)) && one(fan(12, 1, |_| -3_000_000)));
        assert!(one(fan(12, 1, |k| if k % 6 < 3 { 400_000 } else { -400_000 })));
        assert!(!one(fan(12, 5, |_| -1000)));
        let mut folded = fan(12, 1, |_| 0);
        folded.0[5] = [folded.0[8][0], folded.0[8][1], 1000];
        assert!(!one(folded));
    }

    #[test]
    fn only_a_closed_fan_of_one_searched_group_does() {
        let shape = fan(7, 1, |_| -1000);
        assert!(told(&shape, &[0; 7], &[true]) && !told(&shape, &[0; 7], &[false]));
        assert!(!told(&shape, &[0, 0, 0, 1, 1, 1, 1], &[true, true]));
        let mut open = shape.clone();
        open.1.pop();
        assert!(!told(&open, &[0; 6], &[true]));
        let mut turned = shape.clone();
        turned.1[3].swap(1, 2);
        assert!(!told(&turned, &[0; 7], &[true]));
        let mut twice = shape.clone();
        twice.1.push(twice.1[0]);
        assert!(!told(&twice, &[0; 8], &[true]));
    }
}
