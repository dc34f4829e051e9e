//! The BSP tree: an order of drawing for any viewpoint, from one tree.
//!
//! H. Fuchs, Z. Kedem, B. Naylor, "On visible surface generation by a priori tree structures", 1980.
//!
//! 1. the plane of some polygon divides the rest: front is the side of its normal. A polygon that it passes through is
//!    split; polygons that lie in it stay in the node. The dividing polygon always stays, however little it bends, so
//!    that the tree ends
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
//! The tree is in the model, before any rounding; pictures are made of the rounded facets, each cut by the nodes'
//! planes.

use super::canvas::Canvas;
use super::depth_sort::clip;
use super::limits::Watch;
use super::non_planar::{Flat, plane_of};
use super::pieces::{Half, Painter};
use super::scene::{Camera, Scene};
use super::screen::Screen;
use super::statistics::Statistics;
use super::view::View;

const NIL: u32 = u32::MAX;
/// Polygons tried as a node's plane; the one that splits least is taken.
const TRIED: usize = 5;
/// Share of the scene's extent: a point nearer to a plane than this lies on it. It is the floating-point error and no
/// more: on the screen less than a 256th of a pixel, whatever part of the scene the picture shows.
const ON: f64 = 1.0 / (1u64 << 50) as f64;
/// Share of the largest coordinate: the rounding of the coordinates as they were given.
const GIVEN: f64 = f64::EPSILON;

/// The part of a polygon that is left after cuts by the planes above it in the tree.
#[derive(Clone, Debug)]
pub struct Fragment {
    pub polygon: u32,
    pub loops: Vec<Vec<[f64; 3]>>,
    /// The last cut that made the fragment; each cut leads to the one before. Index into `Tree::cuts`, or NIL.
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
    plane: Flat,
    /// The polygon whose plane it is; NIL once that polygon has been removed.
    own: u32,
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
    /// Plane of each polygon, None for those without area.
    planes: Vec<Option<Flat>>,
    tolerance: f64,
    /// The middle of the scene, from which all coordinates in the tree are measured.
    pub origin: [f64; 3],
}

impl Tree {
    /// Builds the tree; None where time ran out.
    pub fn new(scene: &Scene, watch: &Watch, statistics: &mut Statistics) -> Option<Tree> {
        let mut tree = Tree::default();
        let all: Vec<u32> = (0..scene.len() as u32).collect();
        tree.insert(scene, &all, watch, statistics)?;
        Some(tree)
    }

    /// Inserts polygons: down the existing tree, and on from its leaves.
    pub fn insert(
        &mut self,
        scene: &Scene,
        polygons: &[u32],
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<()> {
        self.planes.resize(scene.len(), None);
        self.measure(scene);
        let origin = self.origin;
        let from_origin = |p: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|k| p[k] - origin[k]) };
        let mut here = Vec::new();
        for &polygon in polygons {
            if watch.over() {
                return None;
            }
            let Some(plane) = plane_of(scene, polygon as usize) else { continue };
            self.planes[polygon as usize] = Some(Flat { base: from_origin(&plane.base), ..plane });
            let corners = |l: &[i32]| l.iter().map(|&i| from_origin(&scene.points[i as usize])).collect();
            here.push(self.keep(Fragment {
                polygon,
                loops: scene.loops_of(polygon as usize).map(corners).collect(),
                cut: NIL,
            }));
        }
        // Work to do: fragments; the slot of a node (parent, side) or the root; its depth in the tree.
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

    /// Sets the origin, if the tree is empty, and the tolerance.
    fn measure(&mut self, scene: &Scene) {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in scene.points {
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        if scene.points.is_empty() {
            return;
        }
        if self.fragments.is_empty() {
            self.origin = std::array::from_fn(|k| low[k] * 0.5 + high[k] * 0.5);
        }
        for k in 0..3 {
            let reach = (high[k] - self.origin[k]).max(self.origin[k] - low[k]);
            self.tolerance = self.tolerance.max(ON * reach + GIVEN * high[k].abs().max(low[k].abs()));
        }
    }

    /// Removes polygons; their planes still divide the others.
    pub fn remove(&mut self, polygons: &[u32]) {
        let mut out = vec![false; self.planes.len()];
        polygons.iter().for_each(|&p| out[p as usize] = true);
        let fragments = &self.fragments;
        for node in &mut self.nodes {
            node.fragments.retain(|&f| !out[fragments[f as usize].polygon as usize]);
            if node.own != NIL && out[node.own as usize] {
                node.own = NIL;
            }
        }
    }

    fn keep(&mut self, fragment: Fragment) -> u32 {
        self.fragments.push(fragment);
        self.fragments.len() as u32 - 1
    }

    /// Makes a node in a slot, with the plane of the polygon, of a few that are tried, that splits least.
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
        let mut best: Option<(usize, u32, Flat)> = None;
        for k in 0..tried {
            let own = self.fragments[fragments[k * count / tried] as usize].polygon;
            let Some(plane) = self.planes[own as usize] else { continue };
            // For a long list a sample is enough.
            let sample = (count / 256).max(1);
            let (mut split, mut balance) = (0usize, 0i64);
            for &f in fragments.iter().step_by(sample) {
                if watch.over() {
                    return None;
                }
                statistics.comparisons += 1;
                match self.side(&self.fragments[f as usize], &plane, own) {
                    Side::Split => split += 1,
                    Side::Front => balance += 1,
                    Side::Behind => balance -= 1,
                    Side::On => {}
                }
            }
            let cost = 8 * split + balance.unsigned_abs() as usize;
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, own, plane));
            }
        }
        let (_, own, plane) = best?;
        let number = self.nodes.len() as u32;
        self.nodes.push(Node { plane, own, fragments: Vec::new(), sides: [NIL; 2] });
        if parent != NIL {
            self.nodes[parent as usize].sides[side] = number;
        }
        Some(number)
    }

    /// Divides fragments into those behind and in front of a node's plane; those in the plane stay in the node.
    fn divide(
        &mut self,
        fragments: &[u32],
        node: u32,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<[Vec<u32>; 2]> {
        let Node { plane, own, .. } = self.nodes[node as usize];
        let mut sides = [Vec::new(), Vec::new()];
        for &f in fragments {
            if watch.over() {
                return None;
            }
            statistics.comparisons += 1;
            match self.side(&self.fragments[f as usize], &plane, own) {
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
                        let half: Vec<_> =
                            loops.iter().map(|l| clip(l, |p| sign * plane.height(p))).filter(|l| l.len() > 2).collect();
                        let part = self.keep(Fragment { polygon, loops: half, cut });
                        sides[k].push(part);
                    }
                }
            }
        }
        Some(sides)
    }

    /// On which side of the plane of the polygon `own` a fragment lies.
    fn side(&self, fragment: &Fragment, plane: &Flat, own: u32) -> Side {
        if fragment.polygon == own {
            return Side::On;
        }
        let heights = fragment.loops.iter().flatten().map(|p| plane.height(p));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        match (low < -self.tolerance, high > self.tolerance) {
            (false, false) => Side::On,
            (true, false) => Side::Behind,
            (false, true) => Side::Front,
            (true, true) => Side::Split,
        }
    }

    /// Fragments in the order of drawing, far to near.
    pub fn order(&self, view: &View, watch: &Watch, mut visit: impl FnMut(u32)) -> Option<()> {
        // Nodes still to enter, and nodes to draw because their far side is done.
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
        let Some(own) = self.planes[fragment.polygon as usize].map(|plane| view.plane(&plane)) else { return };
        let mut at = fragment.cut;
        while at != NIL {
            let cut = self.cuts[at as usize];
            let its = view.plane(&self.nodes[cut.node as usize].plane);
            // The node's plane along the polygon: z is replaced by -(A x + B y + D) / C of the polygon's own plane.
            let sign = if own[2] < 0.0 { -1.0 } else { 1.0 };
            let term = |k: usize| sign * (its[k] * own[2] - its[2] * own[k]);
            let (a, b) = (term(0), term(1));
            // Evaluated at pixel centres.
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

    /// A corner of a fragment in the model.
    pub fn in_model(&self, p: &[f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| p[k] + self.origin[k])
    }

    /// The tree's nodes as (polygons in the node, behind, front), the root first; for teaching.
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

/// Paints the tree's fragments in their order.
pub fn render(
    tree: &Tree,
    screen: &Screen,
    camera: &Camera,
    canvas: &mut Canvas,
    watch: &Watch,
    statistics: &mut Statistics,
) -> Option<()> {
    let Some(view) = View::new(&tree.origin, camera) else { return Some(()) };
    // The facets of each polygon: they are stored one after another.
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
