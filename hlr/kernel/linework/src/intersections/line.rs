//! The curve of one intersection line.

use super::common_point::{NEARLY_TANGENT, Near, common};
use super::conic::conic;
use super::face::Face;
use super::{Crossed, Found, Sheets};
use crate::silhouette::curve::through;
use hlr_accuracy::INTERSECTION_FIT;
use hlr_brep::geometry::curve::Curve;
use hlr_brep::geometry::surface::Surface;
use hlr_brep::geometry::vector::{Vector, add, along, cross, dot, from_line, length, scaled, sub};

const DEEPEST: u32 = 6;
/// Cosine of the angle between tangents of neighbours below which one of them is reversed. Lines turn by less.
const REVERSED: f64 = -0.7;

/// A point of the line.
#[derive(Clone, Copy)]
struct Spot {
    /// Where the meshes cross.
    from: Vector,
    point: Vector,
    uv: [[f64; 2]; 2],
    /// Along the line, in the sense of the walk.
    tangent: Vector,
}

struct Pair<'a> {
    faces: [Face<'a>; 2],
    deflection: f64,
}

/// The curve of line i. `moved`: the points of the meshes on the true surfaces.
pub fn curve(sheets: &Sheets, crossed: &Crossed, moved: &[Option<Vector>], i: usize) -> Option<Found> {
    let (begin, end) = (crossed.offsets[i] as usize, crossed.offsets[i + 1] as usize);
    let of = |k: usize| crossed.triangles[crossed.order[k.min(end - 1)] as usize];
    let [s, t] = of(begin);
    let pair = Pair { faces: [sheets.face(s)?, sheets.face(t)?], deflection: sheets.deflection };
    if pair.faces.iter().all(|face| matches!(face.surface, Surface::Plane(_))) {
        return None;
    }
    let nodes: Vec<usize> = crossed.nodes(i).collect();
    let spot = |(k, &node): (usize, &usize)| {
        let from = crossed.points[node];
        let [a, b] = of(begin + k).map(|t| sheets.place(t, &from).map(|(_, uv)| uv));
        pair.spot(from, moved[node]?, [a?, b?])
    };
    let mut spots: Vec<Option<Spot>> = nodes.iter().enumerate().map(spot).collect();
    turned(&mut spots);
    let kept = rising(&spots)?;
    let closed = nodes[0] == nodes[nodes.len() - 1];
    if closed && kept.len() < 4 {
        return None;
    }
    let used: Vec<&Spot> = kept.iter().filter_map(|&k| spots[k].as_ref()).collect();
    let (mut all, mut dense, mut rise) = (vec![used[0].point], vec![*used[0]], 0.0f64);
    for w in used.windows(2) {
        let first = all.len();
        pair.divide(w[0], w[1], 0, &mut all, &mut dense);
        let above = all[first..].iter().map(|p| from_line(p, &w[0].point, &w[1].point));
        rise = above.fold(rise, f64::max);
    }
    let curve = conic([&pair.faces[0], &pair.faces[1]], &all, pair.deflection).or_else(|| {
        let points: Vec<Vector> = dense.iter().map(|s| s.point).collect();
        let tangents: Vec<Option<Vector>> = dense.iter().map(|s| Some(s.tangent)).collect();
        through(&points, &tangents, &|_| false).map(Curve::Spline)
    })?;
    Some(Found { curve, rise, points: places(&spots, &kept)? })
}

/// The points of the line on its curve. Those left out fall on the one before them; where the surfaces touch, and some
/// are not known, into the middle of the gap, for another line crosses there.
fn places(spots: &[Option<Spot>], kept: &[usize]) -> Option<Vec<Vector>> {
    let mut out = Vec::with_capacity(spots.len());
    for w in kept.windows(2) {
        let (a, b) = (spots[w[0]].as_ref()?, spots[w[1]].as_ref()?);
        let gap = &spots[w[0] + 1..w[1]];
        let between = if gap.iter().any(Option::is_none) { middle(a, b) } else { a.point };
        out.push(a.point);
        out.extend(gap.iter().map(|_| between));
    }
    out.push(spots[*kept.last()?].as_ref()?.point);
    Some(out)
}

/// Tangents are the product of both normals, which keeps its sense along the line, except where the surfaces touch and two
/// lines cross. Here it is the sense of the walk.
fn turned(spots: &mut [Option<Spot>]) {
    let mut before: Option<Vector> = None;
    for spot in spots.iter_mut().flatten() {
        if before.is_some_and(|before| dot(&before, &spot.tangent) < REVERSED) {
            spot.tangent = scaled(&spot.tangent, -1.0);
        }
        before = Some(spot.tangent);
    }
    let known: Vec<&Spot> = spots.iter().flatten().collect();
    let sense: f64 = known.windows(2).map(|w| dot(&w[0].tangent, &sub(&w[1].from, &w[0].from))).sum();
    if sense < 0.0 {
        spots.iter_mut().flatten().for_each(|s| s.tangent = scaled(&s.tangent, -1.0));
    }
}

/// The points that lead onward, with both ends. Points close together step back where they move by more than that. None
/// where an end is not known, or where the line itself turns back.
fn rising(spots: &[Option<Spot>]) -> Option<Vec<usize>> {
    let onward = |a: usize, b: usize| {
        let (Some(a), Some(b)) = (&spots[a], &spots[b]) else { return false };
        let step = sub(&b.point, &a.point);
        dot(&step, &a.tangent) > 0.0 && dot(&step, &b.tangent) > 0.0
    };
    let last = spots.len() - 1;
    spots[0].as_ref()?;
    spots[last].as_ref()?;
    let mut out: Vec<usize> = vec![0];
    for k in 1..last {
        if onward(out[out.len() - 1], k) {
            out.push(k);
        }
    }
    while out.len() > 1 && !onward(out[out.len() - 1], last) {
        out.pop();
    }
    if !onward(out[out.len() - 1], last) {
        return None;
    }
    out.push(last);
    // Points that step back are few; where they are many, something else is wrong.
    (2 * out.len() > spots.len()).then_some(out)
}

impl Pair<'_> {
    /// A point on both faces, with its tangent. `uv`: parameters nearby.
    fn spot(&self, from: Vector, point: Vector, uv: [[f64; 2]; 2]) -> Option<Spot> {
        let [a, b] = &self.faces;
        let (a, b) = (a.foot(&point, uv[0])?, b.foot(&point, uv[1])?);
        let way = cross(&a.normal, &b.normal);
        let sine = length(&way);
        (sine > NEARLY_TANGENT).then(|| Spot { from, point, uv: [a.uv, b.uv], tangent: scaled(&way, 1.0 / sine) })
    }

    /// Appends the middle of a piece, then its end, to `all`; to `used` the middle only where a cubic would miss it.
    fn divide(&self, a: &Spot, b: &Spot, depth: u32, all: &mut Vec<Vector>, used: &mut Vec<Spot>) {
        let start = middle(a, b);
        let [x, y] = self.faces;
        let near = &mut [Near { face: x, uv: a.uv[0] }, Near { face: y, uv: a.uv[1] }];
        let found = common(near, &start, self.deflection.max(length(&sub(&b.point, &a.point))));
        let missed = |point: &Vector| length(&sub(point, &start)) > INTERSECTION_FIT * self.deflection;
        let spot = found
            .filter(|point| depth < DEEPEST && missed(point))
            .and_then(|point| self.spot(start, point, [near[0].uv, near[1].uv]));
        let Some(mut spot) = spot else {
            // Where the surfaces touch, the cubic alone tells the way.
            all.extend([found.unwrap_or(start), b.point]);
            used.push(*b);
            return;
        };
        if dot(&spot.tangent, &sub(&b.point, &a.point)) < 0.0 {
            spot.tangent = scaled(&spot.tangent, -1.0);
        }
        self.divide(a, &spot, depth + 1, all, used);
        self.divide(&spot, b, depth + 1, all, used);
    }
}

/// The middle of the cubic between two points, as `through` draws it.
fn middle(a: &Spot, b: &Spot) -> Vector {
    let half = (0.5 * (1.0 + dot(&a.tangent, &b.tangent).clamp(-0.5, 1.0))).sqrt();
    let span = 2.0 * length(&sub(&b.point, &a.point)) / (1.0 + half);
    let bow = scaled(&sub(&a.tangent, &b.tangent), span / 8.0);
    along(&scaled(&add(&a.point, &b.point), 0.5), &bow, 1.0)
}
