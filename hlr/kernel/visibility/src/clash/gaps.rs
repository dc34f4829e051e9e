//! Gaps in real intersection lines: whether what lies between two ends goes on with one of the lines.

use super::reach::Vec3;
use hlr_mesh::vector::{dot, sub};

/// Cosine of the largest angle at which a gap goes on with the line that it continues.
const ONWARD: f64 = 0.25;
/// In lengths of the gap: so far a line is followed back to see where it comes from. Where facets of two meshes cross, it
/// runs in steps, and only over several of them it has a direction.
const BACK: f64 = 4.0;
/// Segments of a line that are followed back at most.
const STEPS: usize = 64;

/// A segment of a real line, seen from one of its ends.
#[derive(Clone, Copy)]
struct Arm {
    node: i32,
    far_node: i32,
    at: Vec3,
    far: Vec3,
}

/// What is found by following a line back from a gap: whether it runs toward the gap in the gap's own direction, and
/// whether it is longer than the gap.
#[derive(Default)]
struct Line {
    onward: bool,
    long: bool,
}

/// The segments of real lines, by the nodes at their ends.
#[derive(Default)]
pub struct Arms(Vec<Arm>);

/// A segment in a gap: its ends and their nodes, the number of its connected figure, and the contact tolerance.
pub struct Gap {
    pub nodes: [i32; 2],
    pub ends: [Vec3; 2],
    pub figure: usize,
    pub touch: f64,
}

/// A mean of points.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: Vec3,
    number: f64,
}

impl Mean {
    fn add(&mut self, point: &Vec3) {
        self.sum = [0, 1, 2].map(|k| self.sum[k] + point[k]);
        self.number += 1.0;
    }

    fn without(self, point: &Vec3) -> Mean {
        Mean { sum: sub(&self.sum, point), number: self.number - 1.0 }
    }

    fn point(&self) -> Vec3 {
        self.sum.map(|x| x / self.number)
    }
}

impl Arms {
    /// Add a segment; afterwards they must be sorted.
    pub fn add(&mut self, [a, b]: [i32; 2], [from, to]: [Vec3; 2]) {
        self.0.push(Arm { node: a, far_node: b, at: from, far: to });
        self.0.push(Arm { node: b, far_node: a, at: to, far: from });
    }

    pub fn sort(&mut self) {
        self.0.sort_by_key(|arm| arm.node);
    }

    fn at(&self, node: i32) -> &[Arm] {
        let first = self.0.partition_point(|arm| arm.node < node);
        let count = self.0[first..].iter().take_while(|arm| arm.node == node).count();
        &self.0[first..first + count]
    }

    /// Per figure of gaps, of which there are `count`: whether it lies between two nodes of real lines and continues one
    /// of them. A node belongs to one figure.
    ///
    /// ```text
    ///   ---.         .---     ------. . .               |              The lines go on through a gap at a tangent point,
    ///       ` . . . '         ------. . . :        -----+. . . . . .   or turn back there. But a line along a shaft, where
    ///      continues          does so, too              |  does not    its facets cross those of the bore, begins square
    /// ```                                                              to the rim.
    pub fn continued(&self, gaps: impl Iterator<Item = Gap>, count: usize) -> Vec<bool> {
        let mut held: Vec<(i32, Vec3, usize, f64)> = Vec::new();
        let (mut all, mut nodes) = (vec![Mean::default(); count], vec![Mean::default(); count]);
        for gap in gaps {
            for (node, end) in gap.nodes.into_iter().zip(gap.ends) {
                all[gap.figure].add(&end);
                if !self.at(node).is_empty() {
                    held.push((node, end, gap.figure, gap.touch));
                }
            }
        }
        held.sort_by_key(|&(node, ..)| node);
        held.dedup_by_key(|(node, ..)| *node);
        for (_, at, figure, _) in &held {
            nodes[*figure].add(at);
        }
        let (mut found, mut onward, mut long) = (vec![false; count], vec![false; count], vec![0; count]);
        for &(node, at, figure, touch) in held.iter().filter(|&&(_, _, figure, _)| nodes[figure].number > 1.0) {
            // To the other nodes, and to the middle of the gap, which may lie far from the way between the nodes.
            let ahead = [nodes[figure].without(&at), all[figure]].map(|mean| sub(&mean.point(), &at));
            found[figure] |= dot(&ahead[0], &ahead[0]) < touch * touch;
            let mut reaches = false;
            for arm in self.at(node) {
                found[figure] |= ahead.iter().any(|ahead| arm.leads(&at, ahead));
                let line = self.followed(*arm, &ahead[0]);
                onward[figure] |= line.onward;
                reaches |= line.long;
            }
            long[figure] += i32::from(reaches);
        }
        // What looks onward from afar counts between two long lines only: a rim of a bore is cut into short pieces.
        (0..count).map(|f| found[f] || onward[f] && long[f] > 1).collect()
    }

    /// The line that ends with this segment, followed back from a gap. ahead: through the gap.
    fn followed(&self, mut arm: Arm, ahead: &Vec3) -> Line {
        let (here, length) = (arm.at, dot(ahead, ahead));
        let mut line = Line::default();
        for _ in 0..STEPS {
            let way = sub(&here, &arm.far);
            let back = dot(&way, &way);
            line.onward |= arm.leads(&here, ahead);
            line.long |= back >= length;
            if line.onward && line.long || back > BACK * BACK * length {
                break;
            }
            let [one, two] = self.at(arm.far_node) else { break };
            arm = if one.far_node == arm.node { *two } else { *one };
        }
        line
    }
}

impl Arm {
    /// Whether the way from its far end to the gap goes on ahead.
    fn leads(&self, here: &Vec3, ahead: &Vec3) -> bool {
        let way = sub(here, &self.far);
        dot(&way, ahead) >= ONWARD * (dot(&way, &way) * dot(ahead, ahead)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two lines, from nodes 0 and 1 back through these points, and a gap from node to node through `gap`.
    fn is_continued(lines: [&[Vec3]; 2], gap: &[Vec3]) -> bool {
        let (mut arms, mut next) = (Arms::default(), 2);
        for (line, mut node) in lines.iter().zip(0..) {
            for step in line.windows(2) {
                arms.add([node, next], [step[0], step[1]]);
                (node, next) = (next, next + 1);
            }
        }
        arms.sort();
        let way: Vec<Vec3> = [&[lines[0][0]], gap, &[lines[1][0]]].concat();
        let last = way.len() - 2;
        let node = |i: usize| {
            if i == 0 {
                0
            } else if i > last {
                1
            } else {
                100 + i as i32
            }
        };
        let gaps = (0..=last).map(|i| Gap {
            nodes: [node(i), node(i + 1)],
            ends: [way[i], way[i + 1]],
            figure: 0,
            touch: 0.01,
        });
        arms.continued(gaps, 1)[0]
    }

    const LONG: [Vec3; 3] = [[0.0, 0.0, 0.0], [0.0, 0.5, 0.0], [-3.0, 2.0, 0.0]];

    #[test]
    fn a_line_that_comes_to_a_gap_in_steps_goes_on_there() {
        assert!(is_continued([&LONG, &[[1.0, 0.0, 0.0], [1.0, 2.0, 0.0]]], &[]));
    }

    #[test]
    fn beside_a_short_piece_of_a_rim_it_does_not() {
        assert!(!is_continued([&LONG, &[[1.0, 0.0, 0.0], [1.0, 0.2, 0.0]]], &[]));
    }

    #[test]
    fn between_long_lines_square_to_it_there_is_no_gap() {
        let square = [[0.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 3.0, 0.0]];
        assert!(!is_continued([&square, &[[1.0, 0.0, 0.0], [1.0, 2.0, 0.0]]], &[]));
    }

    #[test]
    fn a_gap_may_turn_back() {
        let beside = |x: f64| [[x, 0.0, 0.0], [x, 2.0, 0.0]];
        assert!(is_continued([&beside(0.0), &beside(0.4)], &[[0.1, -2.0, 0.0], [0.3, -2.0, 0.0]]));
        assert!(!is_continued([&beside(0.0), &beside(0.4)], &[[0.2, 0.0, 0.0]]));
    }
}
