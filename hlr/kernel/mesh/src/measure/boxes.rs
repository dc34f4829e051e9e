//! A hierarchy of boxes in N dimensions: median split along the longest side.

/// Factor that covers the rounding of a ray's end at a box, so that no box is missed: T. Ize, "Robust BVH ray
/// traversal", 2013.
const ROUNDED: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Lower and upper corner.
#[derive(Clone, Copy, Debug)]
pub struct Bounds<const N: usize>(pub [f64; N], pub [f64; N]);

impl<const N: usize> Bounds<N> {
    pub const EMPTY: Self = Self([f64::INFINITY; N], [f64::NEG_INFINITY; N]);

    pub fn of(points: &[[f64; N]]) -> Self {
        points.iter().fold(Self::EMPTY, |b, p| b.union(&Self(*p, *p)))
    }

    pub fn union(&self, other: &Self) -> Self {
        let mut out = *self;
        for k in 0..N {
            out.0[k] = out.0[k].min(other.0[k]);
            out.1[k] = out.1[k].max(other.1[k]);
        }
        out
    }

    /// Squared distance of a point from the box; 0 inside.
    pub fn distance2(&self, p: &[f64; N]) -> f64 {
        (0..N).map(|k| (self.0[k] - p[k]).max(p[k] - self.1[k]).max(0.0)).map(|d| d * d).sum()
    }

    /// The least t in 0..most at which origin + t * way is inside the box, None where it never is; inverse: 1 / way.
    pub fn entry(&self, origin: &[f64; N], inverse: &[f64; N], most: f64) -> Option<f64> {
        let (mut near, mut far) = (0.0f64, most);
        for k in 0..N {
            if inverse[k].is_infinite() {
                // The ray is parallel to these sides: 0 * inf would be NaN.
                if origin[k] < self.0[k] || origin[k] > self.1[k] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((self.0[k] - origin[k]) * inverse[k], (self.1[k] - origin[k]) * inverse[k]);
            near = near.max(a.min(b));
            far = far.min(a.max(b) * ROUNDED);
        }
        (near <= far).then_some(near)
    }
}

struct Node<const N: usize> {
    bounds: Bounds<N>,
    /// Leaf: first item. Inner: the right child; the left one follows its parent.
    link: u32,
    /// Leaf: number of items. Inner: 0.
    count: u32,
}

pub struct Tree<const N: usize> {
    nodes: Vec<Node<N>>,
    items: Vec<u32>,
}

const LEAF: usize = 4;

impl<const N: usize> Tree<N> {
    pub fn new(boxes: &[Bounds<N>]) -> Self {
        let mut tree = Self { nodes: Vec::new(), items: (0..boxes.len() as u32).collect() };
        if !boxes.is_empty() {
            tree.split(boxes, 0, boxes.len());
        }
        tree
    }

    fn split(&mut self, boxes: &[Bounds<N>], first: usize, end: usize) {
        let items = &mut self.items[first..end];
        let bounds = items.iter().fold(Bounds::EMPTY, |b, &i| b.union(&boxes[i as usize]));
        let here = self.nodes.len();
        if items.len() <= LEAF {
            self.nodes.push(Node { bounds, link: first as u32, count: items.len() as u32 });
            return;
        }
        self.nodes.push(Node { bounds, link: 0, count: 0 });
        let side = |k: usize| bounds.1[k] - bounds.0[k];
        let axis = (1..N).fold(0, |best, k| if side(k) > side(best) { k } else { best });
        let middle = |i: u32| boxes[i as usize].0[axis] + boxes[i as usize].1[axis];
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
        self.split(boxes, first, first + half);
        self.nodes[here].link = self.nodes.len() as u32;
        self.split(boxes, first + half, end);
    }

    /// Visits the items of all leaves whose boxes, and those above them, `enter` accepts. `enter` returns a rank, or
    /// None to skip a box; the child of lower rank comes first. `visit` gets one item and returns whether it has seen
    /// enough.
    pub fn walk(&self, mut enter: impl FnMut(&Bounds<N>, bool) -> Option<f64>, mut visit: impl FnMut(u32) -> bool) {
        // The tree is at most as deep as the number of items has bits.
        let mut stack = [0u32; 64];
        let mut top = usize::from(!self.nodes.is_empty());
        while top > 0 {
            top -= 1;
            let number = stack[top];
            let node = &self.nodes[number as usize];
            if enter(&node.bounds, true).is_none() {
                continue;
            }
            if node.count > 0 {
                if self.items[node.link as usize..(node.link + node.count) as usize].iter().any(|&i| visit(i)) {
                    return;
                }
                continue;
            }
            let (left, right) = (number + 1, node.link);
            let rank = |n: u32, enter: &mut dyn FnMut(&Bounds<N>, bool) -> Option<f64>| {
                enter(&self.nodes[n as usize].bounds, false).unwrap_or(f64::INFINITY)
            };
            let (a, b) = (rank(left, &mut enter), rank(right, &mut enter));
            (stack[top], stack[top + 1]) = if a <= b { (right, left) } else { (left, right) };
            top += 2;
        }
    }
}
