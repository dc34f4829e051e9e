//! Runs the steps of `lines` in order: from pieces along chains to lines on paper.

use rayon::prelude::*;

use super::candidates::Chains;
use super::coincident::{Widths, uncovered};
use super::drawing::Kind;
use super::ends::Ends;
use super::geometry::Geometry;
use super::meetings::Meetings;
use super::owners::{Order, Owners};
use super::runs::{self, Limits};
use super::short_pieces::short_pieces;
use super::simplify::simplify;
use super::specks::drop_specks;
use super::turned::begin_at_a_turn;
use super::{Polyline, View};
use crate::fit::bezier::Chain;
use crate::fit::pierced::Meeting;
use crate::fit::smooth::smooth;

/// Tolerances: in millimetres on paper, except `space`, in model units.
#[derive(Clone, Copy, Debug)]
pub struct Tolerances {
    pub accuracy: f64,
    /// A figure shorter than this is dropped.
    pub short: f64,
    /// A run shorter than this takes the state of its neighbours.
    pub flip: f64,
    pub stub: f64,
    pub widths: Widths,
    /// Vertices nearer to the line than this are left out, on paper and in space.
    pub flat: f64,
    pub space: f64,
}

/// Further properties of a chain.
#[derive(Clone, Copy, Debug)]
pub struct Trait {
    /// Which of two coincident lines is drawn: first the lower rank / 8, then the nearer line, then the lower rank.
    pub rank: u8,
    /// The chain belongs to a mesh without B-rep.
    pub without_brep: bool,
    pub noisy: bool,
}

impl Tolerances {
    /// The limits within which the runs of a chain are decided. `noise`: see `Geometry::noise`, of the contour of a mesh.
    pub fn limits(&self, of: &Trait, is_intersection: bool, noise: impl FnOnce() -> f64) -> Limits {
        Limits {
            short: self.flip,
            stub: self.stub,
            noise: if of.noisy { noise() } else { self.flip },
            loops: if of.noisy && of.without_brep { self.short } else { 0.0 },
            // Other lines of meshes may be smoothed across what is seen end-on, and lines of B-reps have their curves.
            end_on: if is_intersection && of.without_brep { self.space } else { f64::INFINITY },
        }
    }
}

/// Lines, and the smooth curves of the contours of meshes among them.
#[derive(Default)]
pub struct Cut {
    pub lines: Vec<Polyline>,
    pub smooth: Vec<Option<Chain>>,
    /// Of intersection lines that were moved, sorted by their first coordinate.
    pub meetings: Vec<Meeting>,
}

/// The lines of all chains; None if it was stopped.
pub fn cut(
    geometry: &Geometry,
    chains: &Chains,
    traits: &[Trait],
    t: &Tolerances,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Cut> {
    let view = &geometry.camera.view();
    let met = Meetings::new(geometry, chains, t.accuracy / geometry.camera.scale);
    let mut lines: Vec<Polyline> = (0..traits.len())
        .into_par_iter()
        .flat_map_iter(|c| {
            let (edges, reversed) = chains.of(c);
            let is_intersection = chains.about[c].kind == Kind::INTERSECTION;
            let limits = t.limits(&traits[c], is_intersection, || geometry.noise(edges, t.short));
            // Intersection lines go through nothing: they lie on both surfaces.
            let through = |p: &[f64; 3]| !is_intersection && met.at(p);
            runs::cut(geometry, edges, reversed, c as u32, &limits, &through)
        })
        .collect();
    if stopped() {
        return None;
    }
    lines.par_iter_mut().for_each(|line| begin_at_a_turn(line, t.widths));
    let owners: Vec<Owners> = lines.iter().map(|line| Owners::of(&chains.about[line.chain as usize])).collect();
    let short_pieces = short_pieces(&lines, &owners, t.widths);
    let ranks = ranked(&lines, traits, &short_pieces, view, t.space);
    let mut lines = uncovered(lines, &Order { rank: &ranks, owners: &owners }, t.widths, view);
    drop_specks(&mut lines, t.short);
    let of_meshes = traits.iter().any(|of| of.without_brep);
    let ends = Ends::of(if of_meshes { &lines } else { &[] });
    let smooth = lines
        .par_iter_mut()
        .map(|line| {
            let of = traits[line.chain as usize];
            if of.noisy && of.without_brep {
                let (found, chain) = smooth(line, &|p| ends.meet(line, p), t.accuracy, t.space, view);
                *line = found;
                return chain;
            }
            // A crease of a mesh keeps its vertices where other lines end.
            let kept: Vec<usize> = if of.without_brep {
                (0..line.flat.len()).filter(|&i| ends.meet(line, &line.flat[i])).collect()
            } else {
                Vec::new()
            };
            simplify(line, &kept, t.flat, t.space);
            None
        })
        .collect();
    Some(Cut { lines, smooth, meetings: met.moved() })
}

/// A strict order of lines: visible before hidden, then by rank / 8, then nearer first, then by rank, then by coordinates.
/// Input order decides only between lines that are equal in every coordinate. `short_pieces`: the line that each gives way
/// to. It has the rank / 8 of that line, and comes behind all others of it.
pub fn ranked(lines: &[Polyline], traits: &[Trait], short_pieces: &[Option<u32>], view: &View, space: f64) -> Vec<u32> {
    // Depths are rounded coarsely, so that rounding errors do not decide which of two lines at one depth is nearer.
    let grain = 1e-6 * space.max(f64::MIN_POSITIVE / 1e-6);
    let nearest: Vec<f64> = lines
        .par_iter()
        .map(|line| line.space.iter().map(|p| view.depth(p)).fold(f64::INFINITY, f64::min))
        .map(|depth| (depth / grain).round() + 0.0)
        .collect();
    let rank = |line: &Polyline| traits[line.chain as usize].rank;
    let class = |i: u32| {
        let gives_way_to = short_pieces[i as usize];
        (rank(&lines[gives_way_to.unwrap_or(i) as usize]) >> 3, gives_way_to.is_some())
    };
    let mut order: Vec<u32> = (0..lines.len() as u32).collect();
    order.par_sort_by(|&i, &j| {
        let (a, b) = (&lines[i as usize], &lines[j as usize]);
        b.visible
            .cmp(&a.visible)
            .then_with(|| class(i).cmp(&class(j)))
            .then_with(|| nearest[i as usize].total_cmp(&nearest[j as usize]))
            .then_with(|| rank(a).cmp(&rank(b)))
            .then_with(|| {
                let (x, y) = (a.space.iter().flatten(), b.space.iter().flatten());
                x.zip(y).map(|(p, q)| p.total_cmp(q)).find(|o| o.is_ne()).unwrap_or(a.space.len().cmp(&b.space.len()))
            })
    });
    let mut out = vec![0; lines.len()];
    for (r, &i) in order.iter().enumerate() {
        out[i as usize] = r as u32;
    }
    out
}

impl Cut {
    /// Removes the lines of chains that are nowhere visible. Hidden lines of other chains stay: where they meet visible
    /// ones of their chain, both ends are moved together.
    pub fn keep_sighted(&mut self, chains: usize) {
        let mut seen = vec![false; chains];
        self.lines.iter().filter(|line| line.visible).for_each(|line| seen[line.chain as usize] = true);
        let keep: Vec<bool> = self.lines.iter().map(|line| seen[line.chain as usize]).collect();
        let mut k = keep.iter();
        self.lines.retain(|_| *k.next().unwrap_or(&true));
        let mut k = keep.iter();
        self.smooth.retain(|_| *k.next().unwrap_or(&true));
    }
}
