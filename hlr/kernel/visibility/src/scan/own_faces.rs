//! Visibility of edges against the faces they bound, where these are seen nearly edge-on.
//!
//! The edge lies on the true face, but the face's triangles are off it by up to the deflection. Where the face is seen
//! at a large angle, that matters little. Where it is seen edge-on, a slightly displaced triangle can cover the edge
//! over an unlimited length. So there the edge is compared with the triangles of its own face as if it were moved off
//! the face, to the visible side, by more than their deflection: they hide it only if the face really turns in front of
//! it. Where the face turns over along the edge, at the end of its outline, the side changes: beyond that place the
//! edge lies behind the face, wherever its triangles are.
//!
//! ```text
//!      sight  ----------------->     the face F, its triangles /\ and its border o, looked at along F
//!              _.-o-._
//!          F .` /   \ `.            o: behind a triangle only through its deflection
//!           o--/-----\--.           x: moved off the face to the visible side: in front of all of them
//! ```
//!
//! All other polygons are compared with the edge in its true place. Each polygon is counted by itself (`exact_query`),
//! so the sum cannot contradict itself.

use std::ops::Range;

use rayon::prelude::*;

use super::exact_query::ExactQuery;
use super::invisibility::{Piece, Segment, State};
use super::merged::merged;
use super::mesh::Mesh;
use super::polygon_table::PolygonTable;
use super::sheets::Sheets;
use super::slant::Slant;
use super::stretches::{Beside, Stretches};
use crate::boxes::aabb::Aabb;
use hlr_exact::Point;
use hlr_exact::arithmetic::Arithmetic;

/// Stretches, and what they are compared with.
pub struct OwnFaces<'a> {
    pub stretches: &'a Stretches,
    /// Of each triangle its face, numbered through all parts.
    pub triangle_face: &'a [i32],
    /// Depth units of the grid per unit in the image.
    pub depth_scale: f64,
}

/// |N . v|: triangles seen at more are compared with the edge in its true place. Their deflection does not bring them
/// in front of it; if they lie in front of it elsewhere, they really hide it.
const EDGE_ON: f64 = 0.5;

/// Cosine of the angle between the normal of an outline and that of a polygon, or of another outline, that faces it: less
/// than this.
pub const FACING: f64 = -0.5;

const VISIBLE: u8 = Beside::Visible as u8;
const HIDDEN: u8 = Beside::Hidden as u8;

/// The two ends of an edge.
type Ends<'m> = (&'m Point, &'m Point);

struct Decided {
    edge: u32,
    segments: Vec<Segment>,
}

impl OwnFaces<'_> {
    pub const NONE: OwnFaces<'static> = OwnFaces { stretches: &Stretches::NONE, triangle_face: &[], depth_scale: 1.0 };

    /// The edges, each as its stretches, whose triangles of their own faces hide them otherwise than the faces do.
    pub fn differing<A: Arithmetic>(
        &self,
        mesh: &Mesh,
        table: &PolygonTable,
        exact: &ExactQuery,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Vec<Range<usize>> {
        let mut edges = self.stretches.runs();
        edges.retain(|run| !exact.leaves_out(self.stretches.edge[run.start]));
        if edges.is_empty() {
            return Vec::new();
        }
        let sheets = Sheets::of(self.triangle_face, &self.stretches.sheet);
        edges
            .into_par_iter()
            .filter(|run| !stopped() && self.differs::<A>(mesh, table, exact, &sheets, run.clone()))
            .collect()
    }

    /// The pieces (ascending by edge), with those of these edges corrected for their own faces, and the number of edges
    /// whose pieces changed. differing: as of that function
    pub fn applied<A: Arithmetic>(
        &self,
        mesh: &Mesh,
        table: &PolygonTable,
        exact: &ExactQuery,
        differing: &[Range<usize>],
        pieces: Vec<Piece>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> (Vec<Piece>, u64) {
        let drawn = |run: &Range<usize>| {
            let edge = self.stretches.edge[run.start] as u32;
            pieces.partition_point(|p| p.edge < edge)..pieces.partition_point(|p| p.edge <= edge)
        };
        let differ: Vec<&Range<usize>> = differing.iter().filter(|run| !drawn(run).is_empty()).collect();
        if !differ.is_empty() {
            exact.prepare();
        }
        let found: Vec<Decided> = differ
            .par_iter()
            .filter_map(|run| {
                let edge = self.stretches.edge[run.start] as u32;
                if stopped() {
                    return None;
                }
                let mut segments = self.decided::<A>(mesh, table, exact, (*run).clone())?;
                let of_outline = |stretch| self.stretches.beside[stretch] == Beside::Unknown as u8;
                if mesh.incident(edge as usize).is_empty() && (*run).clone().all(of_outline) {
                    // An outline is moved off its face for all polygons alike; what is visible of it then is visible.
                    let lifted: Vec<Segment> = pieces[drawn(run)].iter().map(|p| p.segment).collect();
                    segments = merged(&segments, &lifted, State::less_hidden);
                }
                Some(Decided { edge, segments })
            })
            .collect();
        if found.is_empty() {
            return (pieces, 0);
        }
        let mut out = Vec::with_capacity(pieces.len() + found.len());
        let mut from = 0;
        for Decided { edge, segments } in &found {
            let first = pieces.partition_point(|p| p.edge < *edge);
            out.extend_from_slice(&pieces[from..first]);
            out.extend(segments.iter().map(|&segment| Piece { edge: *edge, segment }));
            from = pieces.partition_point(|p| p.edge <= *edge);
        }
        out.extend_from_slice(&pieces[from..]);
        (out, found.len() as u64)
    }

    /// Whether the triangles of an edge's own faces hide it otherwise than the faces do.
    fn differs<A: Arithmetic>(
        &self,
        mesh: &Mesh,
        table: &PolygonTable,
        exact: &ExactQuery,
        sheets: &Sheets,
        mut stretches: Range<usize>,
    ) -> bool {
        let edge = self.stretches.edge[stretches.start] as usize;
        let culled = self.culled(mesh, table, edge);
        let (mut one, mut two) = (Vec::new(), Vec::new());
        stretches.any(|s| {
            if culled || self.hidden(s, culled) {
                return culled != self.hidden(s, culled);
            }
            let own = self.own_polygons(mesh, exact, sheets, s);
            let delta = self.delta(mesh, edge);
            let as_drawn = |t: usize| match mesh.incident(edge) {
                // Outlines are moved off their face already.
                [] => Some(mesh.ends(edge)),
                _ => self.plain(mesh, s, t),
            };
            let as_they_lie = own.iter().filter_map(|&(t, _)| Some((t, as_drawn(t)?)));
            // Most stretches have no polygon of their own in front of them, wherever they are looked for.
            !own.is_empty()
                && exact.decide_by::<A>(as_they_lie, &delta, &mut one)
                && exact.decide_by::<A>(own.iter().copied(), &delta, &mut two)
                && !one.iter().map(|s| s.state).eq(two.iter().map(|s| s.state))
        })
    }

    fn culled(&self, mesh: &Mesh, table: &PolygonTable, edge: usize) -> bool {
        mesh.groups[mesh.edge_group[edge] as usize].cull && table.turned_away(mesh, mesh.incident(edge))
    }

    /// Whether its own faces hide all of a stretch.
    fn hidden(&self, stretch: usize, culled: bool) -> bool {
        match self.stretches.beside[stretch] {
            HIDDEN => true,
            VISIBLE => false,
            _ => culled,
        }
    }

    /// The pieces of an edge as its own faces hide it; None where that contradicts itself.
    fn decided<A: Arithmetic>(
        &self,
        mesh: &Mesh,
        table: &PolygonTable,
        exact: &ExactQuery,
        stretches: Range<usize>,
    ) -> Option<Vec<Segment>> {
        let culled = self.culled(mesh, table, self.stretches.edge[stretches.start] as usize);
        let mut out: Vec<Segment> = Vec::new();
        for s in stretches {
            let found = if self.hidden(s, culled) {
                vec![Segment { start: 0.0, end: 1.0, state: State::Hidden }]
            } else {
                self.asked::<A>(mesh, exact, s)?
            };
            let [from, to] = self.stretches.range[s];
            let at = |t: f64| if t == 1.0 { to } else { from + (to - from) * t };
            for segment in &found {
                let (start, end) = (at(segment.start), at(segment.end));
                match out.last_mut() {
                    Some(last) if last.state == segment.state => last.end = end,
                    _ if end > start => out.push(Segment { start, end, state: segment.state }),
                    _ => {}
                }
            }
        }
        (!out.is_empty()).then_some(out)
    }

    /// Own polygons that the stretch is compared with when it is moved off their faces, with its ends there.
    fn own_polygons<'m>(
        &self,
        mesh: &'m Mesh,
        exact: &ExactQuery,
        sheets: &Sheets,
        stretch: usize,
    ) -> Vec<(usize, Ends<'m>)> {
        let mut found = Vec::new();
        let (sheet, reach) =
            (|k: usize| self.stretches.sheet[self.stretches.face[k] as usize], self.reach(mesh, stretch));
        for k in self.stretches.faces(stretch) {
            // `off` finds a position for polygons of these sheets alone.
            if (self.stretches.faces(stretch).start..k).all(|before| sheet(before) != sheet(k)) {
                exact.in_front(sheets.tree(exact, sheet(k)), reach, |t| {
                    let off = self.off(mesh, stretch, t);
                    found.extend(off.filter(|_| self.moved(mesh, stretch, t)).map(|ends| (t, ends)));
                });
            }
        }
        found
    }

    /// Segments of a stretch, from all polygons; None where these contradict one another. An outline where its body touches
    /// itself is asked in its true place as well: moved off its face it may come out beside the turn that hides it, while
    /// it is not moved behind the next turn, which faces it.
    fn asked<A: Arithmetic>(&self, mesh: &Mesh, exact: &ExactQuery, stretch: usize) -> Option<Vec<Segment>> {
        // Of each polygon, whether it faces the stretch.
        let mut polygons: Vec<(usize, bool)> = Vec::new();
        exact.in_front(exact.tree(), self.reach(mesh, stretch), |t| polygons.push((t, self.faces(mesh, stretch, t))));
        let moved = self.moved_off::<A>(mesh, exact, stretch, &polygons)?;
        if polygons.iter().all(|&(_, facing)| !facing) {
            return Some(moved);
        }
        let edge = self.stretches.edge[stretch] as usize;
        let (slant, of_others) = (self.slant(mesh), self.delta(mesh, edge));
        let is_own = |t: usize| mesh.triangle_group[t] == mesh.edge_group[edge];
        let delta = |t: usize| if is_own(t) { slant.delta_of_chords(t) } else { of_others(t) };
        let as_they_lie = polygons.iter().filter_map(|&(t, _)| Some((t, self.plain(mesh, stretch, t)?)));
        let mut in_place = Vec::new();
        let decided = exact.decide_by::<A>(as_they_lie, &delta, &mut in_place);
        decided.then(|| merged(&moved, &in_place, State::more_hidden))
    }

    /// The same for these polygons (and whether they face it), of which those of its faces see it moved off them. It is
    /// asked twice: moved for all of their polygons, and for those alone that are seen edge-on. Behind its own face, an
    /// edge may pass from polygons seen at a large angle to polygons seen edge-on: one of the two ways may have a gap
    /// there, the other has none.
    fn moved_off<A: Arithmetic>(
        &self,
        mesh: &Mesh,
        exact: &ExactQuery,
        stretch: usize,
        polygons: &[(usize, bool)],
    ) -> Option<Vec<Segment>> {
        let slant = self.slant(mesh);
        let of_others = self.delta(mesh, self.stretches.edge[stretch] as usize);
        let facing = |t: usize| self.faces(mesh, stretch, t);
        let delta = |t: usize| if facing(t) { slant.delta_of_itself(t) } else { of_others(t) };
        // Of each polygon the ends of the stretch, and whether they differ between the two ways.
        let mut found: Vec<(usize, Ends, bool)> = Vec::new();
        for &(t, facing) in polygons {
            match self.off(mesh, stretch, t) {
                Some(ends) if !facing => found.push((t, ends, !self.moved(mesh, stretch, t))),
                _ => found.extend(self.plain(mesh, stretch, t).map(|ends| (t, ends, false))),
            }
        }
        let mut one = Vec::new();
        if !exact.decide_by::<A>(found.iter().map(|&(t, ends, _)| (t, ends)), &delta, &mut one) {
            return None;
        }
        if found.iter().all(|&(.., differs)| !differs) {
            return Some(one);
        }
        let mut two = Vec::new();
        let second = found.iter().filter_map(|&(t, ends, differs)| {
            let ends = if differs { self.plain(mesh, stretch, t)? } else { ends };
            Some((t, ends))
        });
        let decided = exact.decide_by::<A>(second, &delta, &mut two);
        decided.then(|| merged(&one, &two, State::more_hidden))
    }

    /// A box around all positions of a stretch.
    pub fn reach(&self, mesh: &Mesh, stretch: usize) -> Aabb {
        let (a, b) = mesh.ends(self.stretches.line[stretch] as usize);
        self.stretches.faces(stretch).fold(Aabb::of(&[a, b]), |reach, k| {
            let (a, b) = mesh.ends(self.stretches.off[k] as usize);
            reach.union(&Aabb::of(&[a, b]))
        })
    }

    /// The ends of a stretch in its true place, for a polygon. The end of a stretch is rounded and may lie off the
    /// triangles at its edge; these hide none of it.
    fn plain<'m>(&self, mesh: &'m Mesh, stretch: usize, t: usize) -> Option<Ends<'m>> {
        let beside = mesh.incident(self.stretches.edge[stretch] as usize).contains(&(t as i32));
        (!beside).then(|| mesh.ends(self.stretches.line[stretch] as usize))
    }

    /// The ends of a stretch moved off the face of a polygon; None for polygons of other faces.
    fn off<'m>(&self, mesh: &'m Mesh, stretch: usize, t: usize) -> Option<Ends<'m>> {
        let face = self.triangle_face[t];
        let sheet = self.stretches.sheet[face as usize];
        let bounded = |face: i32| {
            mesh.incident(self.stretches.edge[stretch] as usize).iter().any(|&t| self.triangle_face[t as usize] == face)
        };
        let mine = self.stretches.faces(stretch).find(|&k| self.stretches.face[k] == face);
        let goes_on = || {
            self.stretches
                .faces(stretch)
                .find(|&k| self.stretches.sheet[self.stretches.face[k] as usize] == sheet && !bounded(face))
        };
        mine.or_else(goes_on).map(|k| mesh.ends(self.stretches.off[k] as usize))
    }

    /// Whether a stretch has to be moved off the face of this polygon of its own.
    fn moved(&self, mesh: &Mesh, stretch: usize, t: usize) -> bool {
        self.stretches.dented[stretch] || self.edge_on(mesh, t)
    }

    /// Whether a line of its own stands for the stretch in its true place: an outline that may lie where a body touches
    /// its face.
    pub fn is_replaced(&self, stretch: usize) -> bool {
        self.stretches.line[stretch] != self.stretches.edge[stretch]
    }

    /// Whether a polygon of its own closed body faces an outline, across the gap that the outline is moved into. The
    /// faces at the outline do not, however their triangles lie.
    pub fn faces(&self, mesh: &Mesh, stretch: usize, t: usize) -> bool {
        let (edge, group) = (self.stretches.edge[stretch] as usize, mesh.triangle_group[t]);
        if !self.is_replaced(stretch)
            || mesh.edge_group[edge] != group
            || !mesh.groups[group as usize].cull
            || !mesh.incident(edge).is_empty()
        {
            return false;
        }
        let middle = |(a, b): Ends| [0, 1].map(|k| f64::from(a[k]) + f64::from(b[k]));
        let from = middle(mesh.ends(self.stretches.line[stretch] as usize));
        let to = middle(mesh.ends(self.stretches.off[self.stretches.faces(stretch).start] as usize));
        let outward = [to[0] - from[0], to[1] - from[1]];
        let cosine = |normal: [f64; 3]| normal[0] * outward[0] + normal[1] * outward[1];
        let (slant, length) = (self.slant(mesh), (outward[0] * outward[0] + outward[1] * outward[1]).sqrt());
        // Half of all polygons are turned the same way as the outline: no root is taken for them.
        cosine(slant.across(t)) < 0.0 && cosine(slant.normal(t)) < FACING * length
    }

    fn edge_on(&self, mesh: &Mesh, t: usize) -> bool {
        self.slant(mesh).facing(t) < EDGE_ON
    }

    pub fn slant<'m>(&self, mesh: &'m Mesh<'m>) -> Slant<'m> {
        Slant { mesh, depth_scale: self.depth_scale }
    }

    /// How far an edge is moved toward the viewer, per polygon.
    fn delta<'m>(&self, mesh: &'m Mesh<'m>, edge: usize) -> impl Fn(usize) -> i64 + use<'m> {
        let (slant, group) = (self.slant(mesh), mesh.edge_group[edge]);
        move |t| slant.delta(group, t)
    }
}
