//! Strips of a surface that are narrower than its triangles.
//!
//! Between two outlines that come near one another lies a strip on which f has the other sign. Where it is narrower than
//! the triangles no node lies in it: both outlines would end before the narrows and begin anew behind them.
//!
//! ```text
//!      -       -       -       -                 -       -       -       -
//!        \   /   \   /   \   /                     \   /   \   /   \   /
//!          +       -       +         becomes         +---x---x---x---+       x: nodes within the strip
//!        /   \   /   \   /   \                     /   \   /   \   /   \
//!      -       -       -       -                 -       -       -       -
//! ```
//!
//! From each triangle over which f changes its sign the strip is followed over edges at whose ends f has one sign and
//! between them the other. Where it comes to another such triangle, these edges are `divided` within the strip.

use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use super::contour::same_nodes;
use super::divided::{Cut, Divided};
use super::face::Face;
use super::{Model, TIE};
use hlr_brep::sets::Sets;

/// The mesh with nodes in all strips that narrow between two places at which nodes lie in them; None where there are
/// none. The values of the new nodes are added.
pub fn with_narrows(model: &Model, values: &mut Vec<f64>) -> Option<Divided> {
    let strips = Strips::new(model, values)?;
    let starts = strips.starts();
    if starts.is_empty() {
        return None;
    }
    let found = strips.followed(starts);
    if found.is_empty() {
        return None;
    }
    let cuts: Vec<Cut> = found.iter().map(|narrow| narrow.cut).collect();
    let divided = Divided::new(model, &cuts);
    let more: Vec<f64> = divided.cut_of_node().iter().map(|&cut| found[cut].value).collect();
    values.extend(more);
    Some(divided)
}

/// An edge over which a strip runs between its ends, f there, and the triangles beside it.
struct Narrow {
    cut: Cut,
    value: f64,
    triangles: [i32; 2],
}

struct Strips<'a> {
    model: &'a Model<'a>,
    values: &'a [f64],
    /// Whether a face may have strips: outlines of the others run from border to border.
    sought: Vec<bool>,
}

impl<'a> Strips<'a> {
    fn new(model: &'a Model<'a>, values: &'a [f64]) -> Option<Strips<'a>> {
        let may = |face| Face::new(model, face).is_some_and(|face| face.has_wrinkles());
        let sought: Vec<bool> = (0..).zip(&model.faces).map(|(number, face)| face.curved && may(number)).collect();
        sought.contains(&true).then_some(Strips { model, values, sought })
    }

    fn away(&self, node: i32) -> bool {
        self.values[node as usize] >= -TIE
    }

    /// The corner of a triangle at which f has another sign than at both others.
    fn odd_corner(&self, t: i32) -> Option<usize> {
        let nodes = &self.model.corner[t as usize];
        let known = |&n: &i32| n >= 0 && self.values[n as usize].is_finite();
        if !self.sought[self.model.triangle_face[t as usize] as usize] || !nodes.iter().all(known) {
            return None;
        }
        let away = nodes.map(|n| self.away(n));
        (0..3).find(|&k| away[k] != away[(k + 1) % 3] && away[k] != away[(k + 2) % 3])
    }

    /// Triangles over which f changes its sign and out of which the strip goes on unseen.
    fn starts(&self) -> Vec<i32> {
        let all = (0..self.model.triangles.len() as i32).into_par_iter();
        all.filter(|&t| {
            self.odd_corner(t).is_some_and(|k| {
                let ends = [1, 2].map(|i| self.model.triangles[t as usize][(k + i) % 3]);
                self.between(t, ends).is_some()
            })
        })
        .collect()
    }

    /// The edges over which strips run unseen from one triangle with a change of sign to another, ascending.
    fn followed(&self, starts: Vec<i32>) -> Vec<Narrow> {
        let sides = sides(self.model);
        let mut strips = Sets::new(self.model.triangles.len());
        let mut asked: FxHashMap<i32, Option<Narrow>> = FxHashMap::default();
        let mut open = starts;
        while let Some(t) = open.pop() {
            for e in sides[t as usize].into_iter().filter(|&e| e >= 0) {
                if asked.contains_key(&e) {
                    continue;
                }
                let narrow = self.narrow(e as usize);
                if let Some(Narrow { triangles: [s, u], .. }) = narrow {
                    strips.unite(s as usize, u as usize);
                    open.push(if s == t { u } else { s });
                }
                asked.insert(e, narrow);
            }
        }
        let mut found: Vec<Narrow> = asked.into_values().flatten().collect();
        found.sort_unstable_by_key(|narrow| narrow.cut.edge);
        // Of edges between the same vertices one.
        let mut met: FxHashSet<[i32; 2]> = FxHashSet::default();
        found.retain(|narrow| {
            let [a, b] = self.model.edges[narrow.cut.edge as usize];
            met.insert([a.min(b), a.max(b)])
        });
        let mut ends: Vec<i32> = found.iter().flat_map(|narrow| narrow.triangles).collect();
        ends.sort_unstable();
        ends.dedup();
        let mut count: FxHashMap<usize, u32> = FxHashMap::default();
        for t in ends.into_iter().filter(|&t| self.odd_corner(t).is_some()) {
            *count.entry(strips.first(t as usize)).or_default() += 1;
        }
        // With one end it is only where the strip bulges out of a triangle.
        found.retain(|narrow| count.get(&strips.first(narrow.triangles[0] as usize)).is_some_and(|&ends| ends > 1));
        found
    }

    fn narrow(&self, e: usize) -> Option<Narrow> {
        let model = self.model;
        let around = &model.incident[model.offsets[e] as usize..model.offsets[e + 1] as usize];
        let &[s, t] = around else { return None };
        let ends = model.edges[e];
        let (at, value) = self.between(s, ends)?;
        // At a seam and between two faces both sides have a strip, or none goes on.
        if !same_nodes(model, self.values, e, around) {
            let (_, other) = self.between(t, ends).filter(|_| model.smooth[e])?;
            if (value >= -TIE) != (other >= -TIE) {
                return None;
            }
        }
        Some(Narrow { cut: Cut { edge: e as u32, at }, value, triangles: [s, t] })
    }

    /// Where on an edge of a triangle, from its first to its second end, f has another sign than at both, and f there.
    fn between(&self, t: i32, ends: [i32; 2]) -> Option<(f64, f64)> {
        let number = self.model.triangle_face[t as usize];
        let face = self.sought[number as usize].then(|| Face::new(self.model, number))??;
        let corner = |v: i32| self.model.triangles[t as usize].iter().position(|&c| c == v);
        let [Some(i), Some(j)] = ends.map(corner) else { return None };
        let nodes = [i, j].map(|k| self.model.corner[t as usize][k]);
        if nodes.iter().any(|&n| n < 0) || self.away(nodes[0]) != self.away(nodes[1]) {
            return None;
        }
        least(&face, nodes.map(|n| self.model.uv[n as usize]), nodes.map(|n| self.values[n as usize]))
    }
}

/// Rounds in which the place of the least |f| is looked for.
const ROUNDS: u32 = 10;

/// Where between two places at which f has one sign it has the other, and f there. It is asked where f turns back on the
/// way, as a curve does that bends in one way only.
fn least(face: &Face, uv: [[f64; 2]; 2], f: [f64; 2]) -> Option<(f64, f64)> {
    let sign = f[0].signum();
    let way = [0, 1].map(|k| uv[1][k] - uv[0][k]);
    let place = |t: f64| [0, 1].map(|k| uv[0][k] + t * way[k]);
    let growth = |t: f64| face.growth(place(t), way).map(|growth| sign * growth);
    let (first, last) = (growth(0.0)?, growth(1.0)?);
    if !(first < 0.0 && last > 0.0) {
        return None;
    }
    // It does not fall below the tangents at both ends.
    let meet = (sign * (f[1] - f[0]) - last) / (first - last);
    if sign * f[0] + first * meet > 0.0 {
        return None;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..ROUNDS {
        let middle = 0.5 * (low + high);
        if growth(middle)? < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let at = 0.5 * (low + high);
    let value = face.f(place(at))?;
    (sign * value < -TIE).then_some((at, value))
}

/// The edges of each triangle.
fn sides(model: &Model) -> Vec<[i32; 3]> {
    let mut sides = vec![[-1; 3]; model.triangles.len()];
    for (e, at) in (0..).zip(model.offsets.windows(2)) {
        for &t in &model.incident[at[0] as usize..at[1] as usize] {
            if let Some(free) = sides[t as usize].iter_mut().find(|side| **side < 0) {
                *free = e;
            }
        }
    }
    sides
}
