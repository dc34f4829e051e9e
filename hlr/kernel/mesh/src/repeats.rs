//! Parts that repeat another one in the same place, as patterns gone wrong leave them: n equal bodies in one place.
//!
//! All of them together show what one of them shows, but every surface would be tried with every other: n of them would
//! take n times n as long as one.

use std::ops::Range;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::tables::Tables;

/// A part that repeats an earlier one, and the greatest distance between a point of the one and that of the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeat {
    pub part: i32,
    pub of: i32,
    pub apart: f64,
}

/// Where parts are looked for: those with as many points, triangles and edges, by their marks.
type Key = ([usize; 3], [i64; MARKS]);

/// Numbers that tell where a part is, and how large.
const MARKS: usize = 4;

/// More than marks are off by rounding, as a share of the largest coordinate.
const ROUNDED: f64 = 1e-10;

/// How far parameters of equal surfaces may differ, as a share of the largest.
const ROUNDED_PARAMETER: f64 = 1e-9;

impl Tables {
    /// The parts that have the mesh of an earlier one, with no point farther away than `near`, ascending.
    ///
    /// The earlier one repeats no other: distances do not add up along a row of parts.
    pub fn repeats(&self, near: f64) -> Vec<Repeat> {
        let counts = |part: usize| self.rows(part).map(|rows| rows.len());
        let mut alike: FxHashMap<[usize; 3], usize> = FxHashMap::default();
        (0..self.len()).for_each(|part| *alike.entry(counts(part)).or_default() += 1);
        let largest = self.points.iter().flatten().fold(0.0, |most: f64, c| most.max(c.abs()));
        let width = 2.0 * (near + ROUNDED * largest);
        let marked = |part: usize| (alike[&counts(part)] > 1).then(|| marks(&self.points[self.rows(part)[0].clone()]));
        let marked: Vec<_> = (0..self.len()).into_par_iter().map(marked).collect();
        let mut firsts: FxHashMap<Key, Vec<usize>> = FxHashMap::default();
        let mut out = Vec::new();
        for (part, marks) in marked.into_iter().enumerate() {
            let ([_, triangles, _], counts) = (self.rows(part), counts(part));
            let Some(marks) = marks.filter(|_| !triangles.is_empty()) else { continue };
            // Of cells twice as wide as `near`, a mark less far away lies in this one, or beside it on the nearer side.
            let at = marks.map(|c| c / width);
            let cell = at.map(|c| c.floor() as i64);
            let side = at.map(|c| if c - c.floor() < 0.5 { -1 } else { 1 });
            let step = |corner: usize, k: usize| if corner >> k & 1 == 1 { side[k] } else { 0 };
            let beside = (0..1 << MARKS).map(|corner| std::array::from_fn(|k| cell[k].saturating_add(step(corner, k))));
            let earlier = beside.filter_map(|cell| firsts.get(&(counts, cell))).flatten();
            let repeated = |&first: &usize| self.apart([first, part], near).map(|apart| (first, apart));
            match earlier.filter_map(repeated).min_by_key(|&(first, _)| first) {
                Some((first, apart)) => out.push(Repeat { part: part as i32, of: first as i32, apart }),
                None => firsts.entry((counts, cell)).or_default().push(part),
            }
        }
        out
    }

    /// These tables without the triangles and edges of the chosen parts. Their points and faces are kept.
    pub fn without_meshes(&self, chosen: &[bool]) -> Tables {
        let mut staying = vec![true; self.triangles.len()];
        let (mut edges, mut nodes) = (vec![true; self.edge_index.len()], Vec::new());
        for (part, &chosen) in chosen.iter().enumerate() {
            let [_, triangles, own] = self.rows(part);
            if chosen {
                staying[triangles].fill(false);
                edges[own].fill(false);
            } else {
                nodes.extend(&self.edge_nodes[self.nodes(own)]);
            }
        }
        let mut out = self.with_triangles(&staying, &nodes);
        let mut kept = edges.iter();
        out.edge_index.retain(|_| kept.next() == Some(&true));
        let mut kept = edges.iter();
        out.edge_class.retain(|_| kept.next() == Some(&true));
        out.edge_offsets = vec![0];
        let mut end = 0;
        for (length, _) in self.edge_offsets.windows(2).map(|w| w[1] - w[0]).zip(&edges).filter(|&(_, &kept)| kept) {
            end += length;
            out.edge_offsets.push(end);
        }
        for (part, &chosen) in chosen.iter().enumerate() {
            let own = if chosen { 0 } else { self.rows(part)[2].len() as i32 };
            out.edge_start[part + 1] = out.edge_start[part] + own;
        }
        out
    }

    /// The points, triangles and edges of a part.
    fn rows(&self, part: usize) -> [Range<usize>; 3] {
        [&self.point_start, &self.triangle_start, &self.edge_start].map(|start| range(start, part))
    }

    /// Where the nodes of these edges lie.
    fn nodes(&self, edges: Range<usize>) -> Range<usize> {
        self.edge_offsets[edges.start] as usize..self.edge_offsets[edges.end] as usize
    }

    /// How far apart two parts with as many points, triangles and edges are; None where they differ, or by more than
    /// `near`.
    fn apart(&self, parts: [usize; 2], near: f64) -> Option<f64> {
        let [[p, t, e], [q, u, f]] = parts.map(|part| self.rows(part));
        let mut apart = 0.0f64;
        for (a, b) in self.points[p.clone()].iter().zip(&self.points[q.clone()]) {
            let squared: f64 = (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum();
            apart = apart.max(squared.sqrt());
            if apart > near {
                return None;
            }
        }
        let [a, b] = parts;
        let point = self.point_start[b] - self.point_start[a];
        let node = self.node_start[b] - self.node_start[a];
        let [c, d] = parts.map(|part| range(&self.face_start, part));
        let [i, j] = parts.map(|part| range(&self.node_start, part));
        let [m, n] = [self.nodes(e.clone()), self.nodes(f.clone())];
        let corner = |&corner: &[i32; 3]| corner.map(|i| if i < 0 { i } else { i + node });
        let same = self.brep[a] == self.brep[b]
            && self.joined[a] == self.joined[b]
            && self.precision[a] == self.precision[b]
            && self.face_planar[c.clone()] == self.face_planar[d.clone()]
            && self.face_reversed[c] == self.face_reversed[d]
            && self.edge_index[e.clone()] == self.edge_index[f.clone()]
            && self.edge_class[e.clone()] == self.edge_class[f.clone()]
            && self.triangle_face[t.clone()] == self.triangle_face[u.clone()]
            && self.origin[t.clone()] == self.origin[u.clone()]
            && same_parameters(&self.uv[i], &self.uv[j])
            && self.triangles[t.clone()]
                .iter()
                .map(|t| t.map(|v| v + point))
                .eq(self.triangles[u.clone()].iter().copied())
            && (self.corner.is_empty() || self.corner[t].iter().map(corner).eq(self.corner[u].iter().copied()))
            && lengths(&self.edge_offsets[e.start..=e.end]).eq(lengths(&self.edge_offsets[f.start..=f.end]))
            && self.edge_nodes[m].iter().map(|v| v + point).eq(self.edge_nodes[n].iter().copied());
        same.then_some(apart)
    }
}

/// Whether the parameters of two parts are equal but for rounding: of equal bodies modelled at two places, few are equal to
/// the last bit.
fn same_parameters(one: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let largest = one.iter().flatten().fold(0.0, |most: f64, c| most.max(c.abs()));
    let near = |(a, b): (&f64, &f64)| a == b || (a - b).abs() <= ROUNDED_PARAMETER * largest;
    one.len() == other.len() && one.iter().flatten().zip(other.iter().flatten()).all(near)
}

/// The marks of a part with these points. Where no point is farther than some distance from its copy, no mark is.
///
/// The middle between the first point and the mean of all, and half their mean distance from the first. Sizes of one
/// design may share their first point, or their middle, but hardly all of that.
fn marks(points: &[[f64; 3]]) -> [f64; MARKS] {
    let Some(first) = points.first() else { return [0.0; MARKS] };
    let (mut sum, mut away) = ([0.0; 3], 0.0);
    for p in points {
        let from = [0, 1, 2].map(|k| p[k] - first[k]);
        away += from.iter().map(|c| c * c).sum::<f64>().sqrt();
        (0..3).for_each(|k| sum[k] += from[k]);
    }
    let half = 0.5 / points.len() as f64;
    let [x, y, z] = [0, 1, 2].map(|k| first[k] + half * sum[k]);
    [x, y, z, half * away]
}

fn range(start: &[i32], part: usize) -> Range<usize> {
    start[part] as usize..start[part + 1] as usize
}

fn lengths(offsets: &[i32]) -> impl Iterator<Item = i32> {
    offsets.windows(2).map(|w| w[1] - w[0])
}

#[cfg(test)]
mod tests {
    use super::super::placed::Placed;
    use super::super::tables::tests::one;
    use super::*;
    use hlr_brep::format::IDENTITY;

    /// The body of tables of one part at these distances along x.
    fn row(of: &Tables, at: &[f64]) -> Tables {
        let place = |&x: &f64| [[1.0, 0.0, 0.0, x], IDENTITY[1], IDENTITY[2]];
        let placed: Vec<Placed> = at.iter().map(|x| Placed { part: 0, transform: place(x), precision: 0.0 }).collect();
        of.placed(&placed).unwrap()
    }

    #[test]
    fn parts_in_one_place_repeat_the_first() {
        let found = row(&one(), &[0.0, 5.0, 0.0, 5.0, 0.0]).repeats(1e-3);
        let repeat = |part, of| Repeat { part, of, apart: 0.0 };
        assert_eq!(found, [repeat(2, 0), repeat(3, 1), repeat(4, 0)]);
    }

    #[test]
    fn small_distances_do_not_add_up() {
        let found = row(&one(), &[0.0, 0.9, 1.8, 2.7, -0.9]).repeats(1.0);
        let of: Vec<[i32; 2]> = found.iter().map(|repeat| [repeat.part, repeat.of]).collect();
        assert_eq!(of, [[1, 0], [3, 2], [4, 0]]);
        assert!(found.iter().all(|repeat| (repeat.apart - 0.9).abs() < 1e-12));
    }

    #[test]
    fn parameters_that_differ_by_rounding_are_the_same() {
        let mut two = row(&one(), &[0.0, 0.0]);
        two.uv.fill([2.0, 3.0]);
        let last = two.uv.len() - 1;
        two.uv[last][0] += 1e-13;
        assert_eq!(two.repeats(0.05).len(), 1);
        two.uv[last][0] += 1e-6;
        assert_eq!(two.repeats(0.05), []);
    }

    /// Bodies of as many points, of different sizes, that share their first point or their middle.
    fn sizes(middle: bool, count: usize) -> Tables {
        let mut tables = row(&one(), &vec![0.0; count]);
        for part in 0..count {
            let [points, ..] = tables.rows(part);
            let own = &mut tables.points[points];
            let mean = [0, 1, 2].map(|k| own.iter().map(|p| p[k]).sum::<f64>() / own.len() as f64);
            let fixed = if middle { mean } else { own[0] };
            let size = 1.0 + 0.1 * part as f64;
            own.iter_mut().for_each(|p| *p = [0, 1, 2].map(|k| fixed[k] + size * (p[k] - fixed[k])));
        }
        tables
    }

    #[test]
    fn sizes_of_one_design_have_marks_of_their_own() {
        for middle in [false, true] {
            let tables = sizes(middle, 1000);
            let mut cells: Vec<[i64; MARKS]> = (0..1000)
                .map(|part| marks(&tables.points[tables.rows(part)[0].clone()]).map(|c| (c / 0.002).floor() as i64))
                .collect();
            cells.sort_unstable();
            cells.dedup();
            assert_eq!(cells.len(), 1000, "{middle}");
            assert_eq!(tables.repeats(1e-3), []);
        }
    }

    #[test]
    fn marks_are_no_farther_apart_than_points() {
        let points: Vec<[f64; 3]> = (0..60).map(|k| [0, 1, 2].map(|c| f64::from((7 * k + 13 * c) % 31))).collect();
        for turn in 0..8 {
            let off = |k: usize, c: usize| [-0.5, 0.5][(k >> turn ^ turn >> c) & 1];
            let moved: Vec<[f64; 3]> =
                points.iter().enumerate().map(|(k, p)| [0, 1, 2].map(|c| p[c] + off(k, c))).collect();
            let apart = 0.75f64.sqrt() + 1e-12;
            let pairs = marks(&points).into_iter().zip(marks(&moved));
            pairs.for_each(|(a, b)| assert!((a - b).abs() <= apart, "{turn}: {a} {b}"));
        }
    }

    #[test]
    fn whatever_differs_is_no_repeat() {
        let two = || row(&one(), &[0.0, 0.0]);
        let changes: [fn(&mut Tables); 8] = [
            |t| t.points[6][1] += 0.1,
            |t| t.triangles[5].swap(1, 2),
            |t| t.triangle_face[5] = 0,
            |t| t.face_planar[5] = false,
            |t| t.face_reversed[5] = true,
            |t| t.edge_nodes[5] = 6,
            |t| t.edge_class[3] = 1,
            |t| t.uv[13] = [1.0; 2],
        ];
        assert_eq!(two().repeats(0.05).len(), 1);
        for (k, change) in changes.iter().enumerate() {
            let mut tables = two();
            change(&mut tables);
            assert_eq!(tables.repeats(0.05), [], "{k}");
        }
    }

    #[test]
    fn the_others_stay_as_they_are() {
        let three = row(&one(), &[0.0, 3.0, 6.0]);
        let found = three.without_meshes(&[false, true, false]);
        assert_eq!((found.triangle_start, found.edge_start), (vec![0, 4, 4, 8], vec![0, 2, 2, 4]));
        assert_eq!(found.triangles[4..], three.triangles[8..]);
        assert_eq!((found.edge_offsets, found.edge_nodes), (vec![0, 2, 4, 6, 8], vec![0, 1, 1, 2, 8, 9, 9, 10]));
        assert_eq!((found.edge_index, found.corner[4]), (vec![0, 1, 0, 1], three.corner[8]));
        assert_eq!((found.points, found.face_start), (three.points, three.face_start));
    }
}
