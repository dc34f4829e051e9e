//! Finds where drawn edges pierce polygons: clashing groups, triangle soups, self-intersections, contacts.
//!
//! A sound group never pierces itself, so the search is made only where boxes of different groups overlap, or against
//! a group that is not sound.
//!
//! ```text
//!        f  a \        z
//!   ___________\_____  |      before the plane: in front (not hidden by this polygon)
//!     polygon   \      v      beyond it: behind, +1
//!                b
//! ```

use std::cmp::Ordering;

use rayon::prelude::*;

use super::invisibility::Event;
use super::mesh::Mesh;
use super::polygon_table::{PolygonTable, is_left_out};
use super::slant::Slant;
use crate::boxes::aabb::{Aabb, Item};
use crate::boxes::tree::Tree;
use hlr_exact::Point;
use hlr_exact::arithmetic::{Arithmetic, Ring};
use hlr_exact::predicates::{Cover, is_beside, orient2d, shifted_side};

/// With more other groups than this around one, their boxes are not tested separately.
const MANY_AROUND: usize = 32;

pub struct Piercings<P> {
    pub events: Vec<Vec<Event<P>>>,
    pub tests: u64,
    /// Number of groups for which a search was needed.
    pub groups: usize,
    /// Whether it was, per group; empty where none was.
    pub sought: Vec<bool>,
    /// Drawn edges, ascending, that lie behind a polygon of another group, seen at a slant, by more than the count allows,
    /// and yet touch it.
    pub slanted: Vec<u32>,
}

impl<P> Piercings<P> {
    /// Where none are looked for.
    pub fn none() -> Piercings<P> {
        Piercings { events: Vec::new(), tests: 0, groups: 0, sought: Vec::new(), slanted: Vec::new() }
    }
}

/// Of some of the drawn edges.
struct Found<P> {
    events: Vec<Event<P>>,
    tests: u64,
    slanted: Vec<u32>,
}

/// behind: per group, whether its polygons are left out; empty: of none.
pub fn piercings<A: Arithmetic>(
    mesh: &Mesh,
    table: &PolygonTable,
    slant: Slant,
    drawn: &[u32],
    behind: &[bool],
    stopped: &(dyn Fn() -> bool + Sync),
) -> Piercings<A::Parameter> {
    let boxes = group_boxes(mesh, table);
    let sought = sought_groups(mesh, &boxes);
    let searched = sought.iter().filter(|&&s| s).count();
    if searched == 0 {
        return Piercings::none();
    }
    let largest = Slant::most(mesh.groups.iter().map(|p| p.delta).max().unwrap_or(0));
    let mut members: Vec<Vec<(Aabb, u32)>> = vec![Vec::new(); mesh.groups.len()];
    for (reach, t) in reached(mesh, table, &boxes, &sought, largest) {
        let group = mesh.triangle_group[t as usize];
        if !is_left_out(behind, group) {
            members[group as usize].push((reach, t));
        }
    }
    let trees: Vec<Tree> = members.par_iter().map(|items| Tree::new(items)).collect();
    let live: Vec<Item> = (0..mesh.groups.len()).filter(|&p| sought[p]).map(|p| (boxes[p], p as u32)).collect();
    let groups = Tree::new(&live);
    let found: Vec<Found<A::Parameter>> = drawn
        .par_chunks(256)
        .enumerate()
        .map(|(chunk, edges)| {
            let (mut events, mut tests, mut slanted) = (Vec::new(), 0, Vec::new());
            if stopped() {
                return Found { events, tests, slanted };
            }
            for (i, &e) in edges.iter().enumerate() {
                let own = mesh.edge_group[e as usize];
                if !sought[own as usize] {
                    continue;
                }
                let (a, b) = mesh.ends(e as usize);
                let mut touches = false;
                let reach = Aabb::of(&[a, b]).toward_viewer(largest);
                groups.query(&reach, |other| {
                    if other as i32 == own && mesh.groups[own as usize].sound {
                        return;
                    }
                    let delta = mesh.delta(own, other as i32);
                    let reach = Aabb::of(&[a, b]).toward_viewer(slant.most_of_group(own, other as i32));
                    trees[other as usize].query(&reach, |t| {
                        tests += 1;
                        let Some(cover) = mesh.cover::<A>(t as usize) else { return };
                        let Some(ends) = Ends::over(&cover, a, b) else { return };
                        if is_beside::<A>(a, b, [&cover.p, &cover.q, &cover.r]) {
                            return;
                        }
                        touches = touches || slant.touches(own, &ends.beneath, &cover, t as usize);
                        pierce(&cover, &ends, delta, |at, plain, moved| {
                            events.push(Event { drawn: (chunk * 256 + i) as u32, at, plain, moved });
                        });
                    });
                });
                slanted.extend(touches.then_some(e));
            }
            Found { events, tests, slanted }
        })
        .collect();
    let tests = found.iter().map(|f| f.tests).sum();
    let slanted = found.iter().flat_map(|f| &f.slanted).copied().collect();
    Piercings { events: found.into_iter().map(|f| f.events).collect(), tests, groups: searched, sought, slanted }
}

/// Both ends of an edge, as a polygon sees them.
pub struct Ends<A: Arithmetic> {
    /// Orientations against the polygon's borders.
    sides: [[A::Area; 3]; 2],
    /// How far they lie beneath its plane.
    pub beneath: [A::Volume; 2],
}

impl<A: Arithmetic> Ends<A> {
    /// None if both lie beyond the same border: of most polygons whose boxes meet the edge's, long slanted ones, that is
    /// known after a border or two.
    #[inline(always)]
    pub fn over(cover: &Cover<A>, a: &Point, b: &Point) -> Option<Ends<A>> {
        let zero = A::Area::ZERO;
        let (mut one, mut two) = ([zero; 3], [zero; 3]);
        for k in 0..3 {
            let (p, q) = cover.edge(k);
            (one[k], two[k]) = (orient2d::<A>(p, q, a), orient2d::<A>(p, q, b));
            if one[k] < zero && two[k] < zero {
                return None;
            }
        }
        Some(Ends { beneath: [cover.beneath(a, &one), cover.beneath(b, &two)], sides: [one, two] })
    }
}

/// Reports where an edge passes through the polygon: in its true place, and moved toward the viewer by `delta`.
pub fn pierce<A: Arithmetic>(
    cover: &Cover<A>,
    ends: &Ends<A>,
    delta: i64,
    mut report: impl FnMut(A::Parameter, i32, i32),
) {
    let ([sa, sb], [ga, gb]) = (&ends.sides, ends.beneath);
    let shift = cover.shift(delta);
    if delta == 0 {
        if let Some((at, jump)) = through(cover, sa, sb, ga, gb) {
            report(at, jump, jump);
        }
        return;
    }
    if let Some((at, jump)) = through(cover, sa, sb, ga, gb) {
        report(at, jump, 0);
    }
    if let Some((at, jump)) = through(cover, sa, sb, ga - shift, gb - shift) {
        report(at, 0, jump);
    }
}

/// Parameter and jump where the depths ga, gb beneath the plane change sign inside the polygon. An end point on the
/// plane takes the other's sign, so only a strict change counts. On the polygon's border the shift in depth (-e)
/// moves the piercing along f, and only where f runs along the border does the shift in the image decide.
fn through<A: Arithmetic>(
    cover: &Cover<A>,
    sa: &[A::Area; 3],
    sb: &[A::Area; 3],
    ga: A::Volume,
    gb: A::Volume,
) -> Option<(A::Parameter, i32)> {
    let zero = A::Volume::ZERO;
    if (ga <= zero && gb <= zero) || (ga >= zero && gb >= zero) {
        return None;
    }
    // side(t) * d = sb * ga - sa * gb with t = ga / d, d = ga - gb, so sign(d) = sign(ga).
    let sign_d = if ga > zero { 1 } else { -1 };
    for k in 0..3 {
        let side = match A::compare_products(sb[k], ga, sa[k], gb) {
            Ordering::Greater => sign_d,
            Ordering::Less => -sign_d,
            Ordering::Equal if sa[k] != sb[k] => -sign_d * if sb[k] > sa[k] { 1 } else { -1 },
            Ordering::Equal => {
                let (p, q) = cover.edge(k);
                shifted_side(p, q)
            }
        };
        if side < 0 {
            return None;
        }
    }
    Some((A::piercing(ga, ga - gb), if gb > zero { 1 } else { -1 }))
}

/// Polygons that edges of other groups may reach, with their boxes; and all polygons of groups that are not sound.
fn reached(mesh: &Mesh, table: &PolygonTable, boxes: &[Aabb], sought: &[bool], largest: i64) -> Vec<(Aabb, u32)> {
    let live = || (0..boxes.len()).filter(|&p| sought[p]);
    let items: Vec<Item> = live().map(|p| (boxes[p].toward_viewer(largest), p as u32)).collect();
    let tree = Tree::new(&items);
    // None: so many groups lie around it that all its polygons are taken.
    let mut near: Vec<Option<Vec<Aabb>>> = vec![None; boxes.len()];
    for p in live().filter(|&p| mesh.groups[p].sound) {
        let mut around = Vec::new();
        tree.query(&boxes[p], |other| {
            if other as usize != p && around.len() <= MANY_AROUND {
                around.push(boxes[other as usize].toward_viewer(largest));
            }
        });
        near[p] = (around.len() <= MANY_AROUND).then_some(around);
    }
    (0..mesh.triangles.len() as u32)
        .into_par_iter()
        .with_min_len(1 << 12)
        .filter_map(|t| {
            let group = mesh.triangle_group[t as usize] as usize;
            if !sought[group] || !table.counted(t as usize) {
                return None;
            }
            let (p, q, r) = mesh.corners(t as usize);
            let own = Aabb::of(&[p, q, r]);
            let asked = near[group].as_ref().is_none_or(|near| near.iter().any(|other| other.overlaps(&own)));
            asked.then_some((own, t))
        })
        .collect()
}

/// Around the triangles of each group, and its edges without triangles.
fn group_boxes(mesh: &Mesh, table: &PolygonTable) -> Vec<Aabb> {
    let mut boxes: Vec<Aabb> = table.extents.iter().map(|extent| extent.bounds).collect();
    let bare = (0..mesh.edges.len()).into_par_iter().with_min_len(1 << 14).filter(|&e| mesh.incident(e).is_empty());
    for e in bare.collect::<Vec<usize>>() {
        let (p, q) = mesh.ends(e);
        let b = &mut boxes[mesh.edge_group[e] as usize];
        *b = b.union(&Aabb::of(&[p, q]));
    }
    boxes
}

/// Groups whose box, extended by the contact tolerance, meets another's, and groups that are not sound.
fn sought_groups(mesh: &Mesh, boxes: &[Aabb]) -> Vec<bool> {
    let live: Vec<usize> = (0..boxes.len()).filter(|&p| boxes[p] != Aabb::EMPTY).collect();
    let largest = live.iter().map(|&p| mesh.groups[p].delta).max().unwrap_or(0);
    let items: Vec<Item> = live.iter().map(|&p| (boxes[p].toward_viewer(largest), p as u32)).collect();
    let tree = Tree::new(&items);
    let mut sought = vec![false; boxes.len()];
    for p in live {
        let mut meets = !mesh.groups[p].sound;
        tree.query(&boxes[p].toward_viewer(largest), |other| {
            let delta = mesh.delta(p as i32, other as i32).max(mesh.delta(other as i32, p as i32));
            let (a, b) = (boxes[p].toward_viewer(delta), boxes[other as usize].toward_viewer(delta));
            meets |= other as usize != p && a.overlaps(&b);
        });
        sought[p] = meets;
    }
    sought
}

#[cfg(test)]
mod tests {
    use super::*;
    use hlr_exact::arithmetic::Exact;
    use hlr_exact::parameter::Place;

    type Cover = super::Cover<Exact>;

    fn found(a: Point, b: Point, cover: &Cover, delta: i64) -> Vec<(f64, i32, i32)> {
        let mut out = Vec::new();
        if let Some(ends) = Ends::over(cover, &a, &b) {
            pierce(cover, &ends, delta, |at, plain, moved| out.push((at.value(), plain, moved)));
        }
        out
    }

    #[test]
    fn a_needle_through_a_triangle() {
        let t = Cover::new(&[0, 0, 0], &[10, 0, 0], &[0, 10, 0]).unwrap();
        assert_eq!(found([1, 1, -4], [3, 3, 4], &t, 0), [(0.5, 1, 1)]);
        assert_eq!(found([3, 3, 4], [1, 1, -4], &t, 0), [(0.5, -1, -1)]);
        assert_eq!(found([1, 1, -4], [3, 3, 4], &t, 2), [(0.5, 1, 0), (0.75, 0, 1)]);
        assert!(found([1, 1, 0], [3, 3, 4], &t, 0).is_empty());
        assert!(found([8, 8, -4], [9, 9, 4], &t, 0).is_empty());
    }

    #[test]
    fn a_needle_through_a_shared_edge_pierces_one_of_two_triangles() {
        let left = Cover::new(&[0, 0, 0], &[10, 10, 0], &[0, 10, 0]).unwrap();
        let right = Cover::new(&[0, 0, 0], &[10, 0, 0], &[10, 10, 0]).unwrap();
        for (a, b) in [([3, 5, -4], [7, 5, 4]), ([2, 2, -4], [8, 8, 4]), ([5, 7, 4], [5, 3, -4])] {
            assert_eq!(found(a, b, &left, 0).len() + found(a, b, &right, 0).len(), 1);
        }
    }
}
