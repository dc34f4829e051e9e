//! Bounding boxes of facets, and a hierarchy of them: a ray skips every subtree whose box it misses.
//!
//! S. Rubin, T. Whitted, "A 3-dimensional representation for fast rendering of complex scenes", 1980.

use super::limits::Watch;
use super::screen::Screen;
use super::statistics::{Statistics, bytes_of};

/// Columns and rows of pixel centres, end exclusive, and depths.
#[derive(Clone, Copy, Debug)]
pub struct Box3 {
    pub columns: [i32; 2],
    pub rows: [i32; 2],
    pub depth: [i64; 2],
}

impl Box3 {
    pub fn of(screen: &Screen, facet: u32) -> Box3 {
        let f = &screen.facets[facet as usize];
        Box3 { columns: f.columns, rows: f.rows, depth: f.depth }
    }

    /// Whether the ray through a pixel enters the box. All rays run along z: the projective map has made them parallel.
    #[inline(always)]
    pub fn is_hit(&self, column: i32, row: i32) -> bool {
        self.columns[0] <= column && column < self.columns[1] && self.rows[0] <= row && row < self.rows[1]
    }

    pub fn union(&self, other: &Box3) -> Box3 {
        let join = |a: [i32; 2], b: [i32; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Box3 {
            columns: join(self.columns, other.columns),
            rows: join(self.rows, other.rows),
            depth: [self.depth[0].min(other.depth[0]), self.depth[1].max(other.depth[1])],
        }
    }
}

pub struct Hierarchy {
    nodes: Vec<Node>,
    facets: Vec<u32>,
    boxes: Vec<Box3>,
}

struct Node {
    bounds: Box3,
    /// Leaf: its facets. Inner node: empty; its left child follows it, its right child is `right`.
    facets: std::ops::Range<u32>,
    right: u32,
}

const LEAF: usize = 4;

impl Hierarchy {
    pub fn new(screen: &Screen, watch: &Watch) -> Option<Hierarchy> {
        let count = screen.facets.len();
        let boxes = (0..count as u32).map(|f| Box3::of(screen, f)).collect();
        let mut out = Hierarchy { nodes: Vec::new(), facets: (0..count as u32).collect(), boxes };
        if count > 0 {
            out.build(0, count, watch)?;
        }
        Some(out)
    }

    fn build(&mut self, first: usize, end: usize, watch: &Watch) -> Option<()> {
        if watch.over() {
            return None;
        }
        let boxes = &self.boxes;
        let bounds = self.facets[first..end].iter().map(|&f| boxes[f as usize]).reduce(|a, b| a.union(&b))?;
        let here = self.nodes.len();
        if end - first <= LEAF {
            self.nodes.push(Node { bounds, facets: first as u32..end as u32, right: 0 });
            return Some(());
        }
        self.nodes.push(Node { bounds, facets: 0..0, right: 0 });
        // Divided along the longer side of the picture: rays do not differ in depth.
        let wide = bounds.columns[1] - bounds.columns[0] >= bounds.rows[1] - bounds.rows[0];
        let middle = first + (end - first) / 2;
        self.facets[first..end].select_nth_unstable_by_key(middle - first, |&f| {
            let b = &boxes[f as usize];
            let range = if wide { b.columns } else { b.rows };
            (range[0] + range[1], f)
        });
        self.build(first, middle, watch)?;
        self.nodes[here].right = self.nodes.len() as u32;
        self.build(middle, end, watch)
    }

    /// Visits facets whose boxes the ray enters, the nearer subtree first. Before each box `nearest` is asked whether
    /// anything beyond the box's nearest depth still matters.
    pub fn along(
        &self,
        column: i32,
        row: i32,
        statistics: &mut Statistics,
        mut test: impl FnMut(u32, &mut Statistics) -> f64,
    ) {
        let mut nearest = f64::INFINITY;
        // The tree is halved at each level, so it is at most as deep as the number of facets has bits.
        let (mut stack, mut top) = ([0u32; 64], usize::from(!self.nodes.is_empty()));
        while top > 0 {
            top -= 1;
            let number = stack[top];
            let node = &self.nodes[number as usize];
            statistics.box_tests += 1;
            if !node.bounds.is_hit(column, row) || node.bounds.depth[0] as f64 > nearest {
                continue;
            }
            if node.right == 0 {
                for &f in &self.facets[node.facets.start as usize..node.facets.end as usize] {
                    let bounds = &self.boxes[f as usize];
                    if bounds.is_hit(column, row) && bounds.depth[0] as f64 <= nearest {
                        nearest = test(f, statistics);
                    }
                }
            } else {
                let (left, right) = (number + 1, node.right);
                let begins = |n: u32| self.nodes[n as usize].bounds.depth[0];
                let (near, far) = if begins(left) <= begins(right) { (left, right) } else { (right, left) };
                (stack[top], stack[top + 1]) = (far, near);
                top += 2;
            }
        }
    }

    pub fn bytes(&self) -> usize {
        bytes_of(&self.nodes) + bytes_of(&self.facets) + bytes_of(&self.boxes)
    }
}
