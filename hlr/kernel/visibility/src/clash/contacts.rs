//! Separates real intersections from contacts, where surfaces only touch.
//!
//! A crossing that is neither deep nor steep is a contact, unless it closes a gap in a real intersection line: crossing
//! surfaces may be tangent at a point.

use super::depth::{Bodies, Depth, SLIGHT_ANGLE};
use super::gaps::{Arms, Gap};
use super::reach::Vec3;
use super::search::Clash;
use hlr_accuracy::{CONTACT_REAL, INTERSECTION_SHALLOW};
use hlr_mesh::topology::components;
use hlr_mesh::vector::sub;

/// Longest gap to close, in units of the square root of (contact tolerance times the smaller part's size). Surfaces
/// with that size as radius, tangent at a point, differ by less than the tolerance over 2.8 of these units.
const BRIDGE: f64 = 4.0;
/// In sizes of the triangles involved. A figure in which a solid meets itself and that is no larger than this comes
/// from the tessellation, not from the shape: triangles around one point of a curved face cross one another.
const SMALL: f64 = 2.0;

/// A segment of an intersection line: the numbers of its end points, and of its groups, each with the lower first; and a
/// triangle of each group that it lies on.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    pub ends: [i32; 2],
    pub groups: [usize; 2],
    pub triangles: [u32; 2],
    /// Its whole figure is shallow: see `shallow`.
    pub shallow: bool,
}

/// One distinct segment. Several pairs of triangles may meet along it, as where an edge lies in a plane.
struct Candidate {
    segment: Segment,
    clash: Clash,
    depth: Depth,
    sine: f64,
}

/// Returns the real intersection segments, and which groups pass through themselves.
///
/// `found`: sorted by groups. `ends`, `depth`: per clash. `points`: the points that `ends` are indices of. `width`: per
/// group the longest side of its box, in model units. The segments are sorted by the numbers of their ends, not of
/// their groups, which follow the order of triangles in the file.
pub fn real(
    bodies: &Bodies,
    found: &[Clash],
    ends: &[[i32; 2]],
    depth: &[Depth],
    points: &[Vec3],
    width: &[f64],
) -> (Vec<Segment>, Vec<bool>) {
    let all = candidates(bodies, found, ends, depth);
    let nodes = nodes(&all);
    let keep = crossing(bodies, &all, &nodes, points, width);
    let kept: Vec<usize> = (0..all.len()).filter(|&i| keep[i]).collect();
    let mut through = vec![false; bodies.touch.len()];
    for &i in &kept {
        let [a, b] = all[i].segment.groups;
        through[a] |= a == b;
    }
    let small = small(bodies, &all, &kept, &nodes, points);
    let shallow = shallow(bodies, &all, &kept, &nodes);
    let segment = |(&i, shallow): (&usize, bool)| Segment { shallow, ..all[i].segment };
    let drawn = kept.iter().zip(shallow).zip(small).filter(|(_, small)| !small);
    let mut out: Vec<Segment> = drawn.map(|(of, _)| segment(of)).collect();
    out.sort_by_key(|segment| segment.ends);
    (out, through)
}

/// The distinct segments, sorted by groups, then ends. Each has the greatest depth and sine of all clashes along it.
fn candidates(bodies: &Bodies, found: &[Clash], ends: &[[i32; 2]], depth: &[Depth]) -> Vec<Candidate> {
    let mut order: Vec<usize> = (0..found.len()).collect();
    let key = |i: &usize| (bodies.groups(&found[*i]), ends[*i]);
    order.sort_by_key(key);
    let one = |same: &[usize]| {
        let most = |of: &dyn Fn(usize) -> f64| same.iter().map(|&i| of(i)).fold(f64::NEG_INFINITY, f64::max);
        let first = same[0];
        Candidate {
            segment: Segment {
                ends: ends[first],
                groups: bodies.groups(&found[first]),
                triangles: found[first].triangles,
                shallow: false,
            },
            clash: found[first],
            depth: Depth {
                touch: depth[first].touch,
                level: most(&|i| depth[i].level),
                beyond: most(&|i| depth[i].beyond),
                certain: most(&|i| depth[i].certain),
                reach: most(&|i| depth[i].reach),
            },
            sine: most(&|i| found[i].meeting.sine),
        }
    };
    order.chunk_by(|a, b| key(a) == key(b)).map(one).collect()
}

/// Numbers of end points, separate for each pair of groups.
struct Nodes {
    of: Vec<[i32; 2]>,
    count: usize,
}

fn nodes(all: &[Candidate]) -> Nodes {
    let mut nodes = Nodes { of: Vec::with_capacity(all.len()), count: 0 };
    for of_pair in all.chunk_by(|a, b| a.segment.groups == b.segment.groups) {
        let mut ends: Vec<i32> = of_pair.iter().flat_map(|c| c.segment.ends).collect();
        ends.sort_unstable();
        ends.dedup();
        let number = |end: i32| (nodes.count + ends.partition_point(|&e| e < end)) as i32;
        nodes.of.extend(of_pair.iter().map(|c| c.segment.ends.map(number)));
        nodes.count += ends.len();
    }
    nodes
}

/// Per chosen segment the number of its connected figure, and the number of figures.
fn figures(nodes: &Nodes, chosen: &[usize]) -> (Vec<usize>, usize) {
    let edges: Vec<[i32; 2]> = chosen.iter().map(|&i| nodes.of[i]).collect();
    let found: Vec<usize> = components(&edges, nodes.count).into_iter().map(|label| label as usize).collect();
    let figures = found.iter().max().map_or(0, |&last| last + 1);
    (found, figures)
}

/// Which segments are neither contacts nor flush.
fn crossing(bodies: &Bodies, all: &[Candidate], nodes: &Nodes, points: &[Vec3], width: &[f64]) -> Vec<bool> {
    let clear = |i: &usize| all[*i].depth.beyond >= 0.0 || all[*i].sine >= SLIGHT_ANGLE;
    let (sure, slight): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(clear);
    let mut out = vec![false; all.len()];
    let (figure, count) = figures(nodes, &sure);
    let (mut deepest, mut certain) = (vec![-1.0f64; count], vec![false; count]);
    for (&i, &f) in sure.iter().zip(&figure) {
        deepest[f] = deepest[f].max(all[i].depth.beyond);
        certain[f] |= all[i].depth.certain >= 0.0;
    }
    let mut arms = Arms::default();
    for (&i, &f) in sure.iter().zip(&figure).filter(|(_, f)| deepest[**f] >= 0.0) {
        out[i] = true;
        // The rims of a shaft in its bore, both of coarse facets, are shallow figures: between them facets cross all along
        // the shaft, and that is no line.
        if certain[f] {
            arms.add(nodes.of[i], all[i].segment.ends.map(|end| points[end as usize]));
        }
    }
    arms.sort();
    let (bridge, count) = figures(nodes, &slight);
    let extent = extents(all, &slight, &bridge, count, points);
    let as_gap = |(&i, &figure): (&usize, &usize)| Gap {
        nodes: nodes.of[i],
        ends: all[i].segment.ends.map(|end| points[end as usize]),
        figure,
        touch: all[i].depth.touch,
    };
    let continued = arms.continued(slight.iter().zip(&bridge).map(as_gap), count);
    let mut deepest = vec![0.0f64; count];
    for (&i, &f) in slight.iter().zip(&bridge) {
        // Rounding makes faces in one plane cross everywhere. That joins lines over any distance, but is nowhere
        // deep.
        deepest[f] = deepest[f].max(all[i].depth.level / all[i].depth.touch);
    }
    for (&i, &f) in slight.iter().zip(&bridge) {
        let size = all[i].segment.groups.iter().map(|&g| width[g]).fold(f64::INFINITY, f64::min);
        let longest = BRIDGE * (all[i].depth.touch * size).sqrt();
        out[i] = continued[f] && deepest[f] >= CONTACT_REAL && extent[f] < longest;
    }
    all.iter().zip(&mut out).for_each(|(c, out)| *out &= !c.depth.flush(c.sine, bodies.deflection));
    out
}

/// Per figure of chosen segments: the longest side of its bounding box.
fn extents(all: &[Candidate], chosen: &[usize], figure: &[usize], count: usize, points: &[Vec3]) -> Vec<f64> {
    let mut boxes = vec![([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]); count];
    for (&i, &f) in chosen.iter().zip(figure) {
        let (low, high) = &mut boxes[f];
        for &end in &all[i].segment.ends {
            for k in 0..3 {
                let x = points[end as usize][k];
                (low[k], high[k]) = (low[k].min(x), high[k].max(x));
            }
        }
    }
    boxes.iter().map(|(low, high)| sub(high, low).into_iter().fold(0.0, f64::max)).collect()
}

/// The kept segments of figures along which one surface is nowhere deep in the other, so that its own edge may run beside
/// the figure.
fn shallow(bodies: &Bodies, all: &[Candidate], kept: &[usize], nodes: &Nodes) -> Vec<bool> {
    let (figure, count) = figures(nodes, kept);
    let mut deepest = vec![0.0f64; count];
    for (&i, &f) in kept.iter().zip(&figure) {
        deepest[f] = deepest[f].max(all[i].depth.level);
    }
    figure.iter().map(|&f| deepest[f] < INTERSECTION_SHALLOW * bodies.deflection).collect()
}

/// The kept segments in which a solid meets itself, in figures hardly larger than the triangles they lie on.
fn small(bodies: &Bodies, all: &[Candidate], kept: &[usize], nodes: &Nodes, points: &[Vec3]) -> Vec<bool> {
    let (figure, count) = figures(nodes, kept);
    let extent = extents(all, kept, &figure, count, points);
    let mut largest = vec![0.0f64; count];
    for (&i, &f) in kept.iter().zip(&figure) {
        for t in all[i].clash.triangles {
            let corners = bodies.sheet.triangles[t as usize].map(|v| &bodies.sheet.points[v as usize]);
            for k in 0..3 {
                let side = corners.map(|p| p[k]);
                let spread =
                    side.into_iter().fold(f64::NEG_INFINITY, f64::max) - side.into_iter().fold(f64::INFINITY, f64::min);
                largest[f] = largest[f].max(spread);
            }
        }
    }
    let of_one_solid = |i: usize| {
        let [a, b] = all[i].segment.groups;
        a == b && !bodies.without_brep[a]
    };
    kept.iter().zip(&figure).map(|(&i, &f)| of_one_solid(i) && extent[f] < SMALL * largest[f]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::planar_faces::Edges;
    use super::super::planes::Planes;
    use super::super::reach::Sheet;
    use super::super::triangle_pair::Meeting;
    use super::*;

    /// Two walls, `wall` deep in a floor, and a segment between them in which faces meet at no angle, `level` deep. Up to
    /// `certain` a wall only touches the floor in some views.
    fn found(level: f64, wall: f64, certain: f64) -> Vec<Segment> {
        between([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]], level, wall, certain)
    }

    /// The same, of walls from these points to the ends of the gap at x = 1 and x = 2.
    fn between([a, b]: [Vec3; 2], level: f64, wall: f64, certain: f64) -> Vec<Segment> {
        let points = [a, b, [2.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
        let edges = Edges { edges: &[], offsets: &[0], incident: &[] };
        let sheet = Sheet::new(&points, (&[[0, 1, 2]; 2], &[[0.0, 0.0, 1.0]; 2]), (edges, &[]));
        let (planes, touch) = (Planes::default(), [1.0; 2]);
        let without_brep = &[false; 2];
        let bodies = Bodies {
            sheet,
            group: &[0, 1],
            face: &[0, 1],
            planes: &planes,
            without_brep,
            touch: &touch,
            deflection: 0.5,
        };
        let clash = |sine| Clash { triangles: [0, 1], meeting: Meeting { ends: [[0; 3]; 2], depth: 0.0, sine } };
        let depth = |level| Depth { touch: 1.0, level, beyond: level - FORGIVEN, certain: level - certain, reach: 5.0 };
        let found = [clash(1.0), clash(0.0), clash(1.0)];
        let depths = [depth(wall), depth(level), depth(wall)];
        real(&bodies, &found, &[[0, 3], [2, 3], [1, 2]], &depths, &points, &[9.0; 2]).0
    }

    /// Less than the contact depth, as between planar faces.
    const FORGIVEN: f64 = 0.1;

    #[test]
    fn a_gap_between_lines_is_closed_where_it_is_deeper_than_rounding() {
        assert_eq!(found(0.05, 5.0, FORGIVEN).len(), 3);
        assert_eq!(found(1e-7, 5.0, FORGIVEN).len(), 2);
    }

    #[test]
    fn between_lines_square_to_it_no_gap_is_closed() {
        let walls = |a: f64, b: f64| between([[1.0 - a, 2.0, 0.0], [2.0 + b, 2.0, 0.0]], 0.05, 5.0, FORGIVEN).len();
        assert_eq!((walls(0.0, 0.0), walls(0.3, 0.3)), (2, 2));
        assert_eq!((walls(1.0, 1.0), walls(0.0, 1.0)), (3, 3), "one of them goes on");
    }

    #[test]
    fn between_lines_that_are_contacts_in_some_views_no_gap_is_closed() {
        assert_eq!(found(0.05, 0.9, 1.0).len(), 2);
    }

    #[test]
    fn lines_of_what_is_nowhere_deep_are_shallow() {
        let shallow = |wall| found(1e-7, wall, FORGIVEN).iter().all(|segment| segment.shallow);
        assert!(shallow(3.9) && !shallow(4.1));
    }
}
