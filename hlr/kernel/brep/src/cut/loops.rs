//! Closed loops of directed edges on a plane, sorted into faces: each outer loop with the holes in it.

/// A directed edge. `points`: its corners in the plane, in its direction; `ends`: vertices.
pub struct Side {
    pub ends: [u32; 2],
    pub points: Vec<[f64; 2]>,
}

/// Numbers of sides of faces, one list for each loop; the first is the outer one.
pub type FaceLoops = Vec<Vec<usize>>;

/// The faces to the left of the sides. Loops that are `thin` or thinner, as their area over their length, are left out.
///
/// # Errors
/// The sides form no loops, or enclose nothing.
pub fn faces(sides: &[Side], thin: f64) -> Result<Vec<FaceLoops>, &'static str> {
    let mut outer: Vec<(Vec<usize>, Vec<[f64; 2]>, f64)> = Vec::new();
    let mut holes = Vec::new();
    for chain in loops(sides)? {
        let points: Vec<[f64; 2]> =
            chain.iter().flat_map(|&i| &sides[i].points[..sides[i].points.len() - 1]).copied().collect();
        let (area, length) = (area(&points), length(&points));
        if area.abs() <= thin * length {
            continue;
        }
        if area > 0.0 { outer.push((chain, points, area)) } else { holes.push((chain, points)) }
    }
    let mut out: Vec<FaceLoops> = outer.iter().map(|(chain, ..)| vec![chain.clone()]).collect();
    for (chain, points) in holes {
        let place = inside_left(&points);
        let around = (0..outer.len()).filter(|&k| contains(&outer[k].1, place));
        let face = around.min_by(|&a, &b| outer[a].2.total_cmp(&outer[b].2)).ok_or("it is turned inside out")?;
        out[face].push(chain);
    }
    Ok(out)
}

/// Sides chained end to start. Where several begin, the leftmost follows, so that loops touch and do not cross.
fn loops(sides: &[Side]) -> Result<Vec<Vec<usize>>, &'static str> {
    let mut begins: rustc_hash::FxHashMap<u32, Vec<usize>> = rustc_hash::FxHashMap::default();
    for (i, side) in sides.iter().enumerate() {
        begins.entry(side.ends[0]).or_default().push(i);
    }
    let mut used = vec![false; sides.len()];
    let mut out = Vec::new();
    for first in 0..sides.len() {
        if used[first] {
            continue;
        }
        used[first] = true;
        let mut chain = vec![first];
        let mut at = first;
        while sides[at].ends[1] != sides[first].ends[0] || several(&begins, &used, sides, at, first) {
            let choices = begins.get(&sides[at].ends[1]).into_iter().flatten().copied().filter(|&i| !used[i]);
            let next = choices.max_by(|&a, &b| turn(sides, at, a).total_cmp(&turn(sides, at, b)));
            at = next.ok_or("its section does not close")?;
            used[at] = true;
            chain.push(at);
        }
        out.push(chain);
    }
    Ok(out)
}

/// Whether a chain that is back at its start goes on: another side lies further to the left than its first one.
fn several(
    begins: &rustc_hash::FxHashMap<u32, Vec<usize>>,
    used: &[bool],
    sides: &[Side],
    at: usize,
    first: usize,
) -> bool {
    let home = turn(sides, at, first);
    begins.get(&sides[at].ends[1]).into_iter().flatten().any(|&i| !used[i] && turn(sides, at, i) > home)
}

/// The angle by which the way turns to the left from one side to the next, from minus to plus half a turn.
fn turn(sides: &[Side], from: usize, to: usize) -> f64 {
    let (a, b) = (&sides[from].points, &sides[to].points);
    let last = a.len() - 1;
    let u = [a[last][0] - a[last - 1][0], a[last][1] - a[last - 1][1]];
    let v = [b[1][0] - b[0][0], b[1][1] - b[0][1]];
    hlr_exact::elementary::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
}

fn next(points: &[[f64; 2]], i: usize) -> [f64; 2] {
    points[(i + 1) % points.len()]
}

fn area(points: &[[f64; 2]]) -> f64 {
    let [x, y] = points[0];
    let of = |(i, p): (usize, &[f64; 2])| {
        let q = next(points, i);
        (p[0] - x) * (q[1] - y) - (q[0] - x) * (p[1] - y)
    };
    0.5 * points.iter().enumerate().map(of).sum::<f64>()
}

fn length(points: &[[f64; 2]]) -> f64 {
    let of = |(i, p): (usize, &[f64; 2])| {
        let q = next(points, i);
        ((q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1])).sqrt()
    };
    points.iter().enumerate().map(of).sum()
}

/// The middle of the longest side of a loop: a place on it where no other loop touches it.
fn inside_left(points: &[[f64; 2]]) -> [f64; 2] {
    let long = |i: usize| {
        let (p, q) = (points[i], next(points, i));
        (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1])
    };
    let i = (0..points.len()).max_by(|&a, &b| long(a).total_cmp(&long(b))).unwrap_or(0);
    let (p, q) = (points[i], next(points, i));
    [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])]
}

fn contains(points: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let crosses = |i: usize| {
        let (p, q) = (points[i], next(points, i));
        (p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
    };
    (0..points.len()).filter(|&i| crosses(i)).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(first: u32, low: f64, high: f64, hole: bool) -> Vec<Side> {
        let mut corners = [[low, low], [high, low], [high, high], [low, high]];
        if hole {
            corners.reverse();
        }
        let vertex = |k: usize| first + (k % 4) as u32;
        (0..4)
            .map(|k| Side { ends: [vertex(k), vertex(k + 1)], points: vec![corners[k], corners[(k + 1) % 4]] })
            .collect()
    }

    #[test]
    fn holes_belong_to_the_smallest_loop_around_them() {
        let mut sides = square(0, 0.0, 10.0, false);
        sides.extend(square(10, 1.0, 9.0, true));
        sides.extend(square(20, 2.0, 8.0, false));
        sides.extend(square(30, 3.0, 4.0, true));
        let found = faces(&sides, 1e-9).unwrap();
        assert_eq!(found, [vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]], vec![vec![8, 9, 10, 11], vec![12, 13, 14, 15]]]);
        assert!(faces(&sides[4..8], 1e-9).is_err());
        assert!(faces(&sides[1..4], 1e-9).is_err());
        assert_eq!(faces(&sides[..4], 100.0), Ok(Vec::new()));
    }

    #[test]
    fn loops_that_touch_at_a_vertex_are_two() {
        // Two squares with the corner (1, 1) in common.
        let mut sides = square(0, 0.0, 1.0, false);
        sides.extend(square(10, 1.0, 2.0, false));
        sides[4].ends[0] = 2;
        sides[7].ends[1] = 2;
        let found = faces(&sides, 1e-9).unwrap();
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|face| face.len() == 1 && face[0].len() == 4));
    }
}
