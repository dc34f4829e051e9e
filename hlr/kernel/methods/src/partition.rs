//! An equal-count partition: the picture and the depth are halved again and again so that both halves hold as many
//! facets. A uniform grid has empty and crowded cells; these all hold about the same number.
//!
//! After J. Bentley's k-d tree (1975); a facet is in every leaf that it reaches into.

use super::boxes::Box3;
use super::limits::Watch;
use super::screen::Screen;
use super::statistics::{Statistics, bytes_of};

pub struct Partition {
    nodes: Vec<Node>,
    facets: Vec<u32>,
    boxes: Vec<Box3>,
}

enum Node {
    Leaf(std::ops::Range<u32>),
    /// Below `at` the child that follows, otherwise `right`.
    Inner {
        axis: usize,
        at: i64,
        right: u32,
    },
}

const LEAF: usize = 6;
const DEEPEST: usize = 40;

fn range(b: &Box3, axis: usize) -> [i64; 2] {
    match axis {
        0 => [b.columns[0], b.columns[1] - 1].map(i64::from),
        1 => [b.rows[0], b.rows[1] - 1].map(i64::from),
        _ => b.depth,
    }
}

impl Partition {
    pub fn new(screen: &Screen, watch: &Watch) -> Option<Partition> {
        let boxes: Vec<Box3> = (0..screen.facets.len() as u32).map(|f| Box3::of(screen, f)).collect();
        let all = (0..boxes.len() as u32).collect();
        let mut out = Partition { nodes: Vec::new(), facets: Vec::new(), boxes };
        out.build(all, 0, watch)?;
        Some(out)
    }

    fn build(&mut self, here: Vec<u32>, depth: usize, watch: &Watch) -> Option<()> {
        if watch.over() {
            return None;
        }
        let division = if here.len() > LEAF && depth < DEEPEST { self.best(&here) } else { None };
        let Some((axis, at)) = division else {
            let start = self.facets.len() as u32;
            self.facets.extend(here);
            self.nodes.push(Node::Leaf(start..self.facets.len() as u32));
            return Some(());
        };
        let number = self.nodes.len();
        self.nodes.push(Node::Inner { axis, at, right: 0 });
        let below = here.iter().copied().filter(|&f| range(&self.boxes[f as usize], axis)[0] < at).collect();
        let above = here.into_iter().filter(|&f| range(&self.boxes[f as usize], axis)[1] >= at).collect();
        self.build(below, depth + 1, watch)?;
        let next = self.nodes.len() as u32;
        if let Node::Inner { right, .. } = &mut self.nodes[number] {
            *right = next;
        }
        self.build(above, depth + 1, watch)
    }

    /// The side along which a cut at the median leaves the fewest facets: one of the picture, or depth, which every ray
    /// crosses, only where neither helps.
    fn best(&self, here: &[u32]) -> Option<(usize, i64)> {
        let mut found: Option<(usize, usize, i64)> = None;
        for axis in 0..3 {
            let mut middles: Vec<i64> =
                here.iter().map(|&f| range(&self.boxes[f as usize], axis).iter().sum::<i64>().div_euclid(2)).collect();
            let half = middles.len() / 2;
            let at = *middles.select_nth_unstable(half).1;
            let below = here.iter().filter(|&&f| range(&self.boxes[f as usize], axis)[0] < at).count();
            let above = here.iter().filter(|&&f| range(&self.boxes[f as usize], axis)[1] >= at).count();
            let larger = below.max(above);
            if axis == 2 && found.is_some() {
                break;
            }
            if 10 * larger < 9 * here.len() && found.is_none_or(|(l, _, _)| below + above < l) {
                found = Some((below + above, axis, at));
            }
        }
        found.map(|(_, axis, at)| (axis, at))
    }

    /// Visits facets in the leaves along the ray, near to far; `test` returns the depth of the nearest hit so far.
    pub fn along(
        &self,
        column: i32,
        row: i32,
        statistics: &mut Statistics,
        mut test: impl FnMut(u32, &mut Statistics) -> f64,
    ) {
        let mut nearest = f64::INFINITY;
        // Nodes, and the least depth of anything in them.
        let (mut stack, mut top) = ([(0u32, f64::NEG_INFINITY); DEEPEST + 8], 1);
        while top > 0 {
            top -= 1;
            let (number, begins) = stack[top];
            statistics.box_tests += 1;
            if begins > nearest {
                continue;
            }
            match &self.nodes[number as usize] {
                Node::Leaf(own) => {
                    for &f in &self.facets[own.start as usize..own.end as usize] {
                        if self.boxes[f as usize].is_hit(column, row) {
                            nearest = test(f, statistics);
                        }
                    }
                }
                Node::Inner { axis: 2, at, right } => {
                    stack[top] = (*right, begins.max(*at as f64));
                    stack[top + 1] = (number + 1, begins);
                    top += 2;
                }
                Node::Inner { axis, at, right } => {
                    let here = i64::from(if *axis == 0 { column } else { row });
                    stack[top] = (if here < *at { number + 1 } else { *right }, begins);
                    top += 1;
                }
            }
        }
    }

    pub fn bytes(&self) -> usize {
        bytes_of(&self.nodes) + bytes_of(&self.facets) + bytes_of(&self.boxes)
    }
}
