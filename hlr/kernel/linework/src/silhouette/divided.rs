//! A mesh of which some edges are divided, and with them the triangles beside these.
//!
//! The new vertices lie on the edges as they are, so that the facets stay where they are. Vertices and nodes keep their
//! numbers. Divided edges and triangles give theirs to their first piece; all other new edges come after the edges and
//! before the intersection lines: first the second pieces of edges, then those between pieces of triangles.

use rustc_hash::FxHashMap;
use smallvec::{SmallVec, smallvec};

use super::Model;
use super::grazing::Grazing;
use hlr_brep::geometry::vector::{Vector, along, sub};

/// Where an edge is divided, as a share of the way from its first end to its second.
#[derive(Clone, Copy)]
pub struct Cut {
    pub edge: u32,
    pub at: f64,
}

pub struct Divided {
    points: Vec<Vector>,
    triangles: Vec<[i32; 3]>,
    triangle_face: Vec<i32>,
    edges: Vec<[i32; 2]>,
    offsets: Vec<i32>,
    incident: Vec<i32>,
    smooth: Vec<bool>,
    source: Vec<i32>,
    corner: Vec<[i32; 3]>,
    uv: Vec<[f64; 2]>,
    cuts: Vec<Cut>,
    /// Of each new node the number of its cut.
    cut_of_node: Vec<usize>,
    /// Edges before the intersection lines, and how many are new.
    old: usize,
    new: usize,
}

/// A vertex and its node.
type Corner = (i32, i32);

/// The vertex at a cut, and its node in each of the two triangles there.
struct Middle {
    vertex: i32,
    nodes: [(i32, i32); 2],
}

impl Middle {
    /// In this triangle; None where that lies at another edge between the same vertices.
    fn corner(&self, t: i32) -> Option<Corner> {
        self.nodes.iter().find(|(beside, _)| *beside == t).map(|&(_, node)| (self.vertex, node))
    }
}

/// The pieces of one triangle, and the edges between them.
type Triangles = SmallVec<[[Corner; 3]; 4]>;
type Inner = SmallVec<[[i32; 2]; 3]>;

/// The pieces of divided triangles, by number.
type Pieces = FxHashMap<i32, SmallVec<[i32; 4]>>;

impl Divided {
    /// Each edge must lie between two triangles. Where these do not share its nodes, at a seam or between two faces, there
    /// are two new ones at its cut.
    pub fn new(model: &Model, cuts: &[Cut]) -> Divided {
        let old = model.edges.len() - model.crossed.len();
        let mut out = Divided {
            points: model.points.to_vec(),
            triangles: model.triangles.to_vec(),
            triangle_face: model.triangle_face.to_vec(),
            edges: model.edges[..old].to_vec(),
            offsets: Vec::new(),
            incident: Vec::new(),
            smooth: model.smooth.to_vec(),
            source: model.source.to_vec(),
            corner: model.corner.to_vec(),
            uv: model.uv.to_vec(),
            cuts: cuts.to_vec(),
            cut_of_node: Vec::new(),
            old,
            new: 0,
        };
        let pieces = out.divide(model, cuts);
        out.new = out.edges.len() - old;
        out.meet(model, &pieces);
        let parts = || cuts.iter().map(|cut| cut.edge as usize);
        let inner = out.new - cuts.len();
        out.smooth.splice(old..old, parts().map(|e| model.smooth[e]).chain(std::iter::repeat_n(true, inner)));
        out.source.splice(old..old, parts().map(|e| model.source[e]).chain(std::iter::repeat_n(-1, inner)));
        out.edges.extend(&model.edges[old..]);
        out
    }

    pub fn model<'a>(&'a self, model: &'a Model<'a>) -> Model<'a> {
        Model {
            points: &self.points,
            triangles: &self.triangles,
            triangle_face: &self.triangle_face,
            edges: &self.edges,
            offsets: &self.offsets,
            incident: &self.incident,
            smooth: &self.smooth,
            source: &self.source,
            corner: &self.corner,
            uv: &self.uv,
            faces: model.faces.clone(),
            ..*model
        }
    }

    /// Of each new node, the last ones of the mesh, the number of its cut.
    pub fn cut_of_node(&self) -> &[usize] {
        &self.cut_of_node
    }

    /// Puts what lies along pieces of edges on the edges as they were, and gives intersection lines their old numbers.
    pub fn restore(&self, grazing: &mut [Grazing]) {
        let cut_of: FxHashMap<u32, f64> = self.cuts.iter().map(|cut| (cut.edge, cut.at)).collect();
        for stretch in grazing.iter_mut() {
            let e = stretch.edge as usize;
            if let Some(&at) = cut_of.get(&stretch.edge) {
                stretch.range = stretch.range.map(|t| t * at);
            } else if e >= self.old + self.new {
                stretch.edge -= self.new as u32;
            } else if let Some(cut) = e.checked_sub(self.old).and_then(|number| self.cuts.get(number)) {
                stretch.edge = cut.edge;
                stretch.range = stretch.range.map(|t| cut.at + t * (1.0 - cut.at));
            }
        }
        grazing.sort_by_key(|stretch| stretch.edge);
    }

    fn divide(&mut self, model: &Model, cuts: &[Cut]) -> Pieces {
        let mut middles: FxHashMap<[i32; 2], Middle> = FxHashMap::default();
        let mut beside: Vec<i32> = Vec::new();
        for (number, cut) in cuts.iter().enumerate() {
            let e = cut.edge as usize;
            let ends = model.edges[e];
            let around = &model.incident[model.offsets[e] as usize..model.offsets[e + 1] as usize];
            let vertex = self.points.len() as i32;
            let [a, b] = ends.map(|v| model.points[v as usize]);
            self.points.push(along(&a, &sub(&b, &a), cut.at));
            let sides = [around[0], around[1]].map(|t| ends.map(|v| node(model, t, v)));
            let mut nodes = [0; 2];
            for k in 0..2 {
                if k == 1 && sides[1] == sides[0] {
                    nodes[1] = nodes[0];
                    continue;
                }
                let [p, q] = sides[k].map(|n| model.uv[n]);
                nodes[k] = self.uv.len() as i32;
                self.uv.push([0, 1].map(|i| p[i] + cut.at * (q[i] - p[i])));
                self.cut_of_node.push(number);
            }
            self.edges[e] = [ends[0], vertex];
            self.edges.push([vertex, ends[1]]);
            middles.insert(sorted(ends), Middle { vertex, nodes: [(around[0], nodes[0]), (around[1], nodes[1])] });
            beside.extend(around);
        }
        beside.sort_unstable();
        beside.dedup();
        beside.into_iter().map(|t| (t, self.divide_triangle(model, t, &middles))).collect()
    }

    fn divide_triangle(&mut self, model: &Model, t: i32, middles: &FxHashMap<[i32; 2], Middle>) -> SmallVec<[i32; 4]> {
        let (vertices, nodes) = (model.triangles[t as usize], model.corner[t as usize]);
        let corners = [0, 1, 2].map(|k| (vertices[k], nodes[k]));
        let middle = [0, 1, 2]
            .map(|k| middles.get(&sorted([vertices[k], vertices[(k + 1) % 3]])).and_then(|middle| middle.corner(t)));
        let (triangles, inner) = pieces(corners, middle);
        self.edges.extend(inner);
        let mut numbers = smallvec![];
        for piece in triangles {
            let (vertices, nodes) = (piece.map(|corner| corner.0), piece.map(|corner| corner.1));
            if numbers.is_empty() {
                (self.triangles[t as usize], self.corner[t as usize]) = (vertices, nodes);
                numbers.push(t);
            } else {
                numbers.push(self.triangles.len() as i32);
                self.triangles.push(vertices);
                self.corner.push(nodes);
                self.triangle_face.push(model.triangle_face[t as usize]);
            }
        }
        numbers
    }

    /// Finds the triangles at each edge.
    fn meet(&mut self, model: &Model, pieces: &Pieces) {
        let mut at_new: FxHashMap<[i32; 2], SmallVec<[i32; 2]>> =
            self.edges[self.old..].iter().map(|&ends| (sorted(ends), smallvec![])).collect();
        let mut all: Vec<i32> = pieces.values().flatten().copied().collect();
        all.sort_unstable();
        for t in all {
            let [a, b, c] = self.triangles[t as usize];
            for ends in [[a, b], [b, c], [c, a]] {
                if let Some(at) = at_new.get_mut(&sorted(ends)) {
                    at.push(t);
                }
            }
        }
        self.offsets.push(0);
        for (e, ends) in self.edges.iter().enumerate() {
            if e < self.old {
                let piece = |t: &i32| {
                    let own = pieces.get(t).into_iter().flatten();
                    let mut at = own.filter(|&&t| ends.iter().all(|v| self.triangles[t as usize].contains(v)));
                    at.next().copied().unwrap_or(*t)
                };
                let around = &model.incident[model.offsets[e] as usize..model.offsets[e + 1] as usize];
                self.incident.extend(around.iter().map(piece));
            } else {
                self.incident.extend(&at_new[&sorted(*ends)]);
            }
            self.offsets.push(self.incident.len() as i32);
        }
    }
}

fn sorted([a, b]: [i32; 2]) -> [i32; 2] {
    [a.min(b), a.max(b)]
}

/// The node of a triangle at one of its vertices.
fn node(model: &Model, t: i32, vertex: i32) -> usize {
    let k = model.triangles[t as usize].iter().position(|&v| v == vertex).unwrap_or(0);
    model.corner[t as usize][k] as usize
}

/// The pieces of a triangle, and the edges between them. middle[k]: where the edge from corner k to the next is divided.
fn pieces(corners: [Corner; 3], middle: [Option<Corner>; 3]) -> (Triangles, Inner) {
    // Turned so that the divided edges come first.
    let first = (0..3).find(|&k| middle[k].is_some() && middle[(k + 2) % 3].is_none()).unwrap_or(0);
    let [a, b, c] = [0, 1, 2].map(|k| corners[(first + k) % 3]);
    let (triangles, inner): (SmallVec<_>, SmallVec<[[Corner; 2]; 3]>) = match [0, 1, 2].map(|k| middle[(first + k) % 3])
    {
        [Some(m), Some(n), Some(p)] => {
            (smallvec![[a, m, p], [m, b, n], [p, n, c], [m, n, p]], smallvec![[m, n], [n, p], [p, m]])
        }
        [Some(m), Some(n), None] => (smallvec![[m, b, n], [a, m, n], [a, n, c]], smallvec![[m, n], [a, n]]),
        [Some(m), None, _] => (smallvec![[a, m, c], [m, b, c]], smallvec![[m, c]]),
        [None, ..] => (smallvec![[a, b, c]], smallvec![]),
    };
    (triangles, inner.into_iter().map(|ends| ends.map(|corner| corner.0)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the area of a triangle with its sign.
    fn area(points: &[[f64; 2]], corners: [Corner; 3]) -> f64 {
        let [a, b, c] = corners.map(|(v, _)| points[v as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    #[test]
    fn pieces_cover_the_triangle_and_keep_its_sense() {
        let points = [[0.0, 0.0], [8.0, 0.0], [0.0, 8.0], [3.0, 0.0], [5.0, 3.0], [0.0, 2.0]];
        let corners = [(0, 10), (1, 11), (2, 12)];
        for mask in 0..8 {
            let middle = [0, 1, 2].map(|k| (mask >> k & 1 == 1).then_some((3 + k, 13 + k)));
            let (found, inner) = pieces(corners, middle);
            let divided = middle.iter().flatten().count();
            let areas: Vec<f64> = found.iter().map(|&piece| area(&points, piece)).collect();
            assert!(areas.iter().all(|&area| area > 0.0) && areas.iter().sum::<f64>() == 64.0, "{mask}: {areas:?}");
            assert_eq!(found.len(), divided + 1, "{mask}");
            assert!(found.iter().flatten().all(|(v, n)| *n == v + 10), "{mask}");
            // Each inner edge lies between two pieces, each other one at one.
            let has = |ends: [i32; 2]| {
                found.iter().filter(|piece| ends.iter().all(|&v| piece.iter().any(|c| c.0 == v))).count()
            };
            assert!(inner.iter().all(|&ends| has(ends) == 2), "{mask}: {inner:?}");
            assert_eq!(3 * found.len(), 2 * inner.len() + 3 + divided, "{mask}");
        }
    }
}
