//! The BSP tree: an order of drawing for any viewpoint, from one tree.
//!
//! H. Fuchs, Z. Kedem, B. Naylor, "On visible surface generation by a priori tree structures", 1980.
//!
//! 1. the plane of some polygon divides the rest: front is the side of its normal. What it passes through is split, what
//!    lies in it stays in the node
//! 2. each side is divided in the same way
//! 3. seen from anywhere: draw the side away from the viewer, then the node, then the viewer's side
//!
//! ```text
//!             a                 viewer o          order: (behind a), a, (before a)
//!        b    |    c
//!       --    |   / d           the tree does not change when the viewer moves;
//!             |  /  --          when a part moves, its polygons are taken out and let in again
//! ```
//!
//! The tree is in the model, before any rounding; pictures are made of the rounded facets, each cut by the nodes' planes.

use super::canvas::Canvas;
use super::depth_sort::clip;
use super::pieces::{Half, Painter};
use super::scene::{Camera, Scene};
use super::screen::Screen;
use super::statistics::Statistics;
use super::warped::plane_of;
use super::watch::Watch;

const NIL: u32 = u32::MAX;
/// Polygons tried as a node's plane; the one that splits least is taken.
const TRIED: usize = 5;
/// Of the scene's size: nearer to a plane is on it.
const ON: f64 = 1e-9;

/// What the planes above have left of a polygon.
#[derive(Clone, Debug)]
pub struct Fragment {
    pub polygon: u32,
    pub loops: Vec<Vec<[f64; 3]>>,
    /// The last cut that made it, and through it those before: index into `Tree::cuts`, or NIL.
    cut: u32,
}

#[derive(Clone, Copy, Debug)]
struct Cut {
    node: u32,
    front: bool,
    before: u32,
}

#[derive(Debug)]
struct Node {
    plane: [f64; 4],
    /// Fragments that lie in the plane.
    fragments: Vec<u32>,
    /// Behind and in front of the plane.
    sides: [u32; 2],
}

#[derive(Debug, Default)]
pub struct Tree {
    nodes: Vec<Node>,
    pub fragments: Vec<Fragment>,
    cuts: Vec<Cut>,
    /// Plane of each polygon, NaN for those without area.
    planes: Vec<[f64; 4]>,
    tolerance: f64,
}

impl Tree {
    /// None where there was no time.
    pub fn new(scene: &Scene, watch: &Watch, statistics: &mut Statistics) -> Option<Tree> {
        let mut tree = Tree::default();
        let all: Vec<u32> = (0..scene.len() as u32).collect();
        tree.insert(scene, &all, watch, statistics)?;
        Some(tree)
    }

    /// Let polygons in: down the tree that is there, and on from its leaves.
    pub fn insert(
        &mut self,
        scene: &Scene,
        polygons: &[u32],
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<()> {
        self.planes.resize(scene.len(), [f64::NAN; 4]);
        let reach = scene.points.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs()));
        self.tolerance = self.tolerance.max(ON * reach);
        let mut here = Vec::new();
        for &polygon in polygons {
            let Some(plane) = plane_of(scene, polygon as usize) else { continue };
            self.planes[polygon as usize] = plane;
            let corners = |l: &[i32]| l.iter().map(|&i| scene.points[i as usize]).collect();
            here.push(self.keep(Fragment {
                polygon,
                loops: scene.loops_of(polygon as usize).map(corners).collect(),
                cut: NIL,
            }));
        }
        // Work still to do: fragments, the slot of a node (parent, side) or the root, and how deep that is.
        let mut work = vec![(here, NIL, 0usize, 1usize)];
        let mut held = 0;
        while let Some((fragments, parent, side, depth)) = work.pop() {
            if fragments.is_empty() {
                continue;
            }
            statistics.at_depth(depth);
            let slot = match parent {
                NIL => {
                    if self.nodes.is_empty() {
                        NIL
                    } else {
                        0
                    }
                }
                _ => self.nodes[parent as usize].sides[side],
            };
            let node = match slot {
                NIL => self.node(&fragments, parent, side, watch, statistics)?,
                _ => slot,
            };
            let sides = self.divide(&fragments, node, watch, statistics)?;
            for (side, list) in sides.into_iter().enumerate() {
                held = held.max(list.len() * 4 * depth);
                work.push((list, node, side, depth + 1));
            }
            if work.len() % 256 == 0 {
                statistics.holds(self.bytes() + held);
            }
        }
        statistics.holds(self.bytes() + held);
        Some(())
    }

    /// Take polygons out; their planes go on dividing what is left.
    pub fn remove(&mut self, polygons: &[u32]) {
        let fragments = &self.fragments;
        for node in &mut self.nodes {
            node.fragments.retain(|&f| !polygons.contains(&fragments[f as usize].polygon));
        }
    }

    fn keep(&mut self, fragment: Fragment) -> u32 {
        self.fragments.push(fragment);
        self.fragments.len() as u32 - 1
    }

    /// A new node in a slot: the plane of the polygon that splits least, of a few.
    fn node(
        &mut self,
        fragments: &[u32],
        parent: u32,
        side: usize,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<u32> {
        let count = fragments.len();
        let tried = TRIED.min(count);
        let mut best = (usize::MAX, [f64::NAN; 4]);
        for k in 0..tried {
            let plane = self.planes[self.fragments[fragments[k * count / tried] as usize].polygon as usize];
            // Of a long list a sample tells enough.
            let sample = (count / 256).max(1);
            let (mut split, mut balance) = (0usize, 0i64);
            for &f in fragments.iter().step_by(sample) {
                if watch.over() {
                    return None;
                }
                statistics.comparisons += 1;
                match self.side(&self.fragments[f as usize], &plane) {
                    Side::Split => split += 1,
                    Side::Front => balance += 1,
                    Side::Behind => balance -= 1,
                    Side::On => {}
                }
            }
            let cost = 8 * split + balance.unsigned_abs() as usize;
            if cost < best.0 {
                best = (cost, plane);
            }
        }
        let number = self.nodes.len() as u32;
        self.nodes.push(Node { plane: best.1, fragments: Vec::new(), sides: [NIL; 2] });
        if parent != NIL {
            self.nodes[parent as usize].sides[side] = number;
        }
        Some(number)
    }

    /// Behind and in front of a node's plane; what lies in it stays.
    fn divide(
        &mut self,
        fragments: &[u32],
        node: u32,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<[Vec<u32>; 2]> {
        let plane = self.nodes[node as usize].plane;
        let mut sides = [Vec::new(), Vec::new()];
        for &f in fragments {
            if watch.over() {
                return None;
            }
            statistics.comparisons += 1;
            match self.side(&self.fragments[f as usize], &plane) {
                Side::On => self.nodes[node as usize].fragments.push(f),
                Side::Behind => sides[0].push(f),
                Side::Front => sides[1].push(f),
                Side::Split => {
                    statistics.splits += 1;
                    let loops = std::mem::take(&mut self.fragments[f as usize].loops);
                    let (polygon, before) = (self.fragments[f as usize].polygon, self.fragments[f as usize].cut);
                    for (k, sign) in [(0, -1.0), (1, 1.0)] {
                        let cut = self.cuts.len() as u32;
                        self.cuts.push(Cut { node, front: k == 1, before });
                        let half: Vec<_> = loops
                            .iter()
                            .map(|l| clip(l, |p| sign * height(p, &plane)))
                            .filter(|l| l.len() > 2)
                            .collect();
                        let part = self.keep(Fragment { polygon, loops: half, cut });
                        sides[k].push(part);
                    }
                }
            }
        }
        Some(sides)
    }

    fn side(&self, fragment: &Fragment, plane: &[f64; 4]) -> Side {
        let heights = fragment.loops.iter().flatten().map(|p| height(p, plane));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        match (low < -self.tolerance, high > self.tolerance) {
            (false, false) => Side::On,
            (true, false) => Side::Behind,
            (false, true) => Side::Front,
            (true, true) => Side::Split,
        }
    }

    /// Fragments in the order of drawing, far to near, seen through `view`: the inverse transpose of the camera's matrix.
    pub fn order(&self, view: &View, watch: &Watch, mut visit: impl FnMut(u32)) -> Option<()> {
        // Nodes to enter, and nodes to draw, whose far side is done.
        let mut stack = if self.nodes.is_empty() { vec![] } else { vec![(0u32, false)] };
        while let Some((number, draw)) = stack.pop() {
            if watch.over() {
                return None;
            }
            let node = &self.nodes[number as usize];
            if draw {
                let mut here = node.fragments.clone();
                here.sort_by_key(|&f| std::cmp::Reverse(self.fragments[f as usize].polygon));
                here.into_iter().for_each(&mut visit);
                continue;
            }
            let near = usize::from(view.before(&node.plane));
            for (next, draw) in [(node.sides[near], false), (number, true), (node.sides[1 - near], false)] {
                if next != NIL {
                    stack.push((next, draw));
                }
            }
        }
        Some(())
    }

    /// The cuts of a fragment as halves of the image.
    pub fn halves(&self, fragment: u32, view: &View, out: &mut Vec<Half>) {
        out.clear();
        let fragment = &self.fragments[fragment as usize];
        let own = view.plane(&self.planes[fragment.polygon as usize]);
        let mut at = fragment.cut;
        while at != NIL {
            let cut = self.cuts[at as usize];
            let its = view.plane(&self.nodes[cut.node as usize].plane);
            // The node's plane where the polygon's is met along the ray of (x, y): z = -(A x + B y + D) / C of its own.
            let sign = if own[2] < 0.0 { -1.0 } else { 1.0 };
            let term = |k: usize| sign * (its[k] * own[2] - its[2] * own[k]);
            let (a, b) = (term(0), term(1));
            // At pixel centres.
            out.push(Half { line: [a, b, term(3) + 0.5 * (a + b)], positive: cut.front });
            at = cut.before;
        }
    }

    pub fn bytes(&self) -> usize {
        use super::statistics::bytes_of;
        bytes_of(&self.nodes)
            + bytes_of(&self.cuts)
            + bytes_of(&self.planes)
            + self.fragments.len()
                * (size_of::<Fragment>() + size_of::<Vec<[f64; 3]>>() + 3 * size_of::<[f64; 3]>() + 4)
    }

    pub fn count(&self) -> usize {
        self.nodes.len()
    }

    /// The tree as (polygons in the node, behind, front), the root first; for teaching.
    pub fn drawn(&self) -> Vec<(Vec<u32>, Option<u32>, Option<u32>)> {
        let child = |n: u32| (n != NIL).then_some(n);
        let polygon = |&f: &u32| self.fragments[f as usize].polygon;
        self.nodes
            .iter()
            .map(|n| (n.fragments.iter().map(polygon).collect(), child(n.sides[0]), child(n.sides[1])))
            .collect()
    }
}

enum Side {
    On,
    Behind,
    Front,
    Split,
}

fn height(p: &[f64; 3], plane: &[f64; 4]) -> f64 {
    plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] - plane[3]
}

/// How planes of the model look on the screen.
pub struct View {
    inverse: [[f64; 4]; 4],
}

impl View {
    /// None where the camera's matrix has no inverse.
    pub fn new(camera: &Camera) -> Option<View> {
        Some(View { inverse: inverse(&camera.matrix)? })
    }

    /// A plane n . p = d as A u + B v + C q + D w, which keeps its sign wherever w is positive.
    fn plane(&self, plane: &[f64; 4]) -> [f64; 4] {
        let given = [plane[0], plane[1], plane[2], -plane[3]];
        std::array::from_fn(|k| (0..4).map(|i| given[i] * self.inverse[i][k]).sum())
    }

    /// Whether the viewer, at depth -inf, is in front of the plane.
    pub fn before(&self, plane: &[f64; 4]) -> bool {
        self.plane(plane)[2] < 0.0
    }
}

/// By Gauss and Jordan, with pivots.
fn inverse(m: &[[f64; 4]; 4]) -> Option<[[f64; 4]; 4]> {
    let mut a: [[f64; 8]; 4] =
        std::array::from_fn(|i| std::array::from_fn(|k| if k < 4 { m[i][k] } else { f64::from(u8::from(k - 4 == i)) }));
    for c in 0..4 {
        let pivot = (c..4).max_by(|&i, &k| a[i][c].abs().total_cmp(&a[k][c].abs()))?;
        a.swap(c, pivot);
        let by = a[c][c];
        if by == 0.0 || !by.is_finite() {
            return None;
        }
        a[c].iter_mut().for_each(|v| *v /= by);
        let row = a[c];
        for (_, other) in a.iter_mut().enumerate().filter(|(i, _)| *i != c) {
            let by = other[c];
            other.iter_mut().zip(row).for_each(|(v, r)| *v -= by * r);
        }
    }
    Some(std::array::from_fn(|i| std::array::from_fn(|k| a[i][4 + k])))
}

/// Paint the tree's fragments in their order.
pub fn render(
    tree: &Tree,
    screen: &Screen,
    camera: &Camera,
    canvas: &mut Canvas,
    watch: &Watch,
    statistics: &mut Statistics,
) -> Option<()> {
    let Some(view) = View::new(camera) else { return Some(()) };
    // The facets of each polygon: they follow one another.
    let polygons = tree.planes.len();
    let mut first = vec![0u32; polygons + 1];
    screen.facets.iter().for_each(|f| first[f.id as usize + 1] += 1);
    for p in 0..polygons {
        first[p + 1] += first[p];
    }
    statistics.holds(tree.bytes() + canvas.bytes());
    let mut order = Vec::new();
    tree.order(&view, watch, |f| order.push(f))?;
    let (mut painter, mut halves) = (Painter::new(screen, canvas, &[], true), Vec::new());
    for f in order {
        let polygon = tree.fragments[f as usize].polygon as usize;
        tree.halves(f, &view, &mut halves);
        for facet in first[polygon]..first[polygon + 1] {
            painter.paint(facet, &halves, watch, statistics)?;
        }
    }
    Some(())
}
