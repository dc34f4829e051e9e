//! Outlines along which another body touches their face: two rollers side by side, or the next turn of a spring.
//!
//! An outline is moved off its face before it is compared with any polygon. Where another body touches the face there,
//! it is moved into that body, which then hides all of it, however short the way. So the hidden ones of these are
//! compared once more, in their true place, with all polygons but those of their own faces (`own_faces`). Where a body
//! touches itself, those polygons count as another body's that face the outline (`OwnFaces::faces`). What a polygon hides
//! from farther away than any contact stays hidden, and is not asked.
//!
//! ```text
//!       sight |  |
//!             v  v
//!          a  )|x(  b      o is the outline of a, x where it is moved to: behind the front of b
//!             )o(
//! ```

use std::ops::Range;

use rayon::prelude::*;

use super::exact_query::ExactQuery;
use super::invisibility::{Piece, State};
use super::mesh::Mesh;
use super::own_faces::OwnFaces;
use crate::boxes::aabb::Aabb;
use hlr_exact::arithmetic::{Arithmetic, Ring};

/// The outlines, each as its stretches, that are hidden in part and lie at polygons of other groups, or at polygons of
/// their own that face them. near: per group, whether others come near it; pieces ascend by edge.
pub fn touching<A: Arithmetic>(
    mesh: &Mesh,
    own: &OwnFaces,
    exact: &ExactQuery,
    near: &[bool],
    pieces: &[Piece],
    stopped: &(dyn Fn() -> bool + Sync),
) -> Vec<Range<usize>> {
    let is_near = |group: i32| near.get(group as usize) == Some(&true);
    let hidden = |edge: u32| {
        let first = pieces.partition_point(|p| p.edge < edge);
        pieces[first..].iter().take_while(|p| p.edge == edge).any(|p| p.segment.state != State::Visible)
    };
    let asked = |run: &Range<usize>| {
        let edge = own.stretches.edge[run.start];
        let is_outline = mesh.incident(edge as usize).is_empty();
        is_outline && own.is_replaced(run.start) && !exact.leaves_out(edge) && hidden(edge as u32)
    };
    let outlines: Vec<Range<usize>> = own.stretches.runs().into_iter().filter(asked).collect();
    if outlines.is_empty() {
        return Vec::new();
    }
    exact.prepare();
    let touches = |run: &Range<usize>| {
        let group = mesh.edge_group[own.stretches.edge[run.start] as usize];
        run.clone().any(|stretch| {
            let mut found = false;
            exact.tree().query(&own.reach(mesh, stretch), |t| {
                let other = mesh.triangle_group[t as usize];
                found |= if other == group { own.faces(mesh, stretch, t as usize) } else { is_near(other) };
            });
            found
        })
    };
    let stays = |run: &Range<usize>| run.clone().all(|stretch| is_far_behind::<A>(mesh, own, exact, stretch));
    outlines.into_par_iter().filter(|run| !stopped() && touches(run) && !stays(run)).collect()
}

/// Whether a single polygon of another group hides a stretch wherever it is moved to, from farther away than any contact.
fn is_far_behind<A: Arithmetic>(mesh: &Mesh, own: &OwnFaces, exact: &ExactQuery, stretch: usize) -> bool {
    let group = mesh.edge_group[own.stretches.edge[stretch] as usize];
    let (slant, reach) = (own.slant(mesh), own.reach(mesh, stretch));
    let Aabb { low, high } = reach;
    // The nearest corners of a box around the stretch: where they all are behind, everything within is.
    let nearest = [low[0], high[0]].map(|x| [low[1], high[1]].map(|y| [x, y, low[2]]));
    exact.any_in_front(reach, |t| {
        let Some(cover) = mesh.cover::<A>(t) else { return false };
        let sides = nearest.as_flattened().iter().map(|corner| (corner, cover.sides(corner)));
        let beneath = |delta: i64| {
            let shift = cover.shift(delta);
            sides.clone().all(|(corner, sides)| {
                sides.iter().all(|side| *side > A::Area::ZERO) && cover.beneath(corner, &sides) > shift
            })
        };
        // How far a contact reaches is asked for last: it takes a root.
        mesh.triangle_group[t] != group && beneath(0) && beneath(slant.delta(group, t))
    })
}
