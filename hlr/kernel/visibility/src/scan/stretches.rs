//! Edges whose own faces are seen nearly edge-on, divided into stretches where a face turns over.

use std::ops::Range;

/// Whether the faces at an edge of a closed body hide it themselves. A convex edge is visible if any of its faces is
/// turned toward the viewer, a concave one if all are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Beside {
    /// A face is parallel to the line of sight, or there are not exactly two faces.
    Unknown = 0,
    Visible = 1,
    Hidden = 2,
}

/// Edges ascend; the stretches of an edge cover all of it. The edges of `line` and `off` have no triangles and are never
/// drawn, except where `line` is the edge itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stretches {
    /// Per stretch: the edge, and its parameters on the edge's image.
    pub edge: Vec<i32>,
    pub range: Vec<[f64; 2]>,
    /// The edge that represents the stretch in its true place: the same edge where the stretch is all of it, and for
    /// outlines, which are moved themselves, where no other body comes near.
    pub line: Vec<i32>,
    /// Whether its own faces hide the stretch, if they belong to a closed body: a `Beside`.
    pub beside: Vec<u8>,
    /// Whether its own triangles fold over there, so that even those seen at a large angle may lie in front of it.
    pub dented: Vec<bool>,
    /// The faces of stretch s are offsets[s]..offsets[s + 1] of `face` and `off`: the number of the face through all
    /// parts, and an edge that is the stretch moved off that face.
    pub offsets: Vec<i32>,
    pub face: Vec<i32>,
    pub off: Vec<i32>,
    /// Per face a number that it shares with the faces that continue it smoothly.
    pub sheet: Vec<i32>,
}

impl Stretches {
    pub const NONE: Stretches = Stretches {
        edge: Vec::new(),
        range: Vec::new(),
        line: Vec::new(),
        beside: Vec::new(),
        dented: Vec::new(),
        offsets: Vec::new(),
        face: Vec::new(),
        off: Vec::new(),
        sheet: Vec::new(),
    };

    /// The edges, each as the range of its stretches.
    pub fn runs(&self) -> Vec<Range<usize>> {
        let mut from = 0;
        let run = |run: &[i32]| {
            from += run.len();
            from - run.len()..from
        };
        self.edge.chunk_by(|a, b| a == b).map(run).collect()
    }

    /// Where the faces of a stretch are in `face` and `off`.
    pub fn faces(&self, stretch: usize) -> Range<usize> {
        self.offsets[stretch] as usize..self.offsets[stretch + 1] as usize
    }

    /// The stretches where some edges (all of them: e) are those of bodies that are closed no longer: what their own faces
    /// hide is not known.
    pub fn opened(&self, open: &[bool]) -> Stretches {
        let mut out = self.clone();
        out.beside
            .iter_mut()
            .zip(&self.edge)
            .filter(|(_, edge)| open[**edge as usize])
            .for_each(|(beside, _)| *beside = Beside::Unknown as u8);
        out
    }

    /// The stretches after edges were renumbered. target: per edge its new number, -1 where it is gone or was cut: such
    /// an edge, and one of whose places is gone, loses all its stretches.
    pub fn renumbered(&self, target: &[i32]) -> Stretches {
        let new = |edge: i32| target[edge as usize];
        let stays = |s: usize| new(self.line[s]) >= 0 && self.off[self.faces(s)].iter().all(|&off| new(off) >= 0);
        let mut kept: Vec<Range<usize>> =
            self.runs().into_iter().filter(|run| new(self.edge[run.start]) >= 0 && run.clone().all(stays)).collect();
        kept.sort_by_key(|run| new(self.edge[run.start]));
        let mut out = Stretches { offsets: vec![0], sheet: self.sheet.clone(), ..Stretches::NONE };
        for s in kept.into_iter().flatten() {
            out.edge.push(new(self.edge[s]));
            out.range.push(self.range[s]);
            out.line.push(new(self.line[s]));
            out.beside.push(self.beside[s]);
            out.dented.push(self.dented[s]);
            out.face.extend(&self.face[self.faces(s)]);
            out.off.extend(self.off[self.faces(s)].iter().map(|&off| new(off)));
            out.offsets.push(out.face.len() as i32);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Edge 2 in two stretches, of which the second lies at two faces; edges 4 and 5 in one.
    fn stretches() -> Stretches {
        Stretches {
            edge: vec![2, 2, 4, 5],
            range: vec![[0.0, 0.5], [0.5, 1.0], [0.0, 1.0], [0.0, 1.0]],
            line: vec![6, 7, 4, 5],
            beside: vec![0, 1, 2, 0],
            dented: vec![false, false, false, true],
            offsets: vec![0, 1, 3, 4, 5],
            face: vec![0, 0, 1, 2, 1],
            off: vec![8, 9, 10, 11, 12],
            sheet: vec![0, 1, 1],
        }
    }

    #[test]
    fn an_edge_is_the_run_of_its_stretches() {
        assert_eq!(stretches().runs(), [0..2, 2..3, 3..4]);
        assert_eq!((stretches().faces(1), Stretches::NONE.runs()), (1..3, vec![]));
    }

    #[test]
    fn what_the_faces_of_an_open_body_hide_is_not_known() {
        let found = stretches().opened(&[false, false, true, false, false, true]);
        assert_eq!(found, Stretches { beside: vec![0, 0, 2, 0], ..stretches() });
    }

    #[test]
    fn stretches_follow_their_edges_to_new_numbers() {
        // Edge 5 becomes 0 and comes first; all others move up by 20.
        let target: Vec<i32> = (0..13).map(|e| if e == 5 { 0 } else { e + 20 }).collect();
        let found = stretches().renumbered(&target);
        let wanted = Stretches {
            edge: vec![0, 22, 22, 24],
            range: vec![[0.0, 1.0], [0.0, 0.5], [0.5, 1.0], [0.0, 1.0]],
            line: vec![0, 26, 27, 24],
            beside: vec![0, 0, 1, 2],
            dented: vec![true, false, false, false],
            offsets: vec![0, 1, 2, 4, 5],
            face: vec![1, 0, 0, 1, 2],
            off: vec![32, 28, 29, 30, 31],
            sheet: vec![0, 1, 1],
        };
        assert_eq!(found, wanted);
    }

    #[test]
    fn an_edge_one_of_whose_places_is_gone_loses_all_its_stretches() {
        // The edge itself, its true place, and the place off its second face.
        for gone in [2, 6, 10] {
            let target: Vec<i32> = (0..13).map(|e| if e == gone { -1 } else { e }).collect();
            let found = stretches().renumbered(&target);
            assert_eq!((found.edge, found.offsets, found.off), (vec![4, 5], vec![0, 1, 2], vec![11, 12]), "{gone}");
        }
        assert_eq!(stretches().renumbered(&[-1; 13]).edge, [0; 0]);
    }
}
