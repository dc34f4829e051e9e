//! The triangles of each sheet: of faces that continue one another smoothly.

use std::sync::OnceLock;

use super::exact_query::ExactQuery;
use crate::boxes::tree::Tree;

/// The triangles of each sheet: members[offsets[s]..offsets[s + 1]]; and their boxes, once they are asked for.
pub struct Sheets {
    offsets: Vec<u32>,
    members: Vec<u32>,
    trees: Vec<OnceLock<Tree>>,
}

impl Sheets {
    /// triangle_face: the face of each triangle; sheet: of each face.
    pub fn of(triangle_face: &[i32], sheet: &[i32]) -> Sheets {
        let triangles = triangle_face.len();
        let count = sheet.iter().max().map_or(0, |&most| most as usize + 1);
        let sheet = |t: usize| sheet[triangle_face[t] as usize] as usize;
        let mut offsets = vec![0u32; count + 1];
        (0..triangles).for_each(|t| offsets[sheet(t) + 1] += 1);
        for s in 0..count {
            offsets[s + 1] += offsets[s];
        }
        let mut next = offsets.clone();
        let mut members = vec![0; triangles];
        for t in 0..triangles {
            let at = &mut next[sheet(t)];
            members[*at as usize] = t as u32;
            *at += 1;
        }
        Sheets { offsets, members, trees: (0..count).map(|_| OnceLock::new()).collect() }
    }

    /// The triangles of a sheet that are counted.
    pub fn tree(&self, exact: &ExactQuery, sheet: i32) -> &Tree {
        let s = sheet as usize;
        self.trees[s].get_or_init(|| {
            let members = &self.members[self.offsets[s] as usize..self.offsets[s + 1] as usize];
            Tree::on_one_thread(&exact.boxes(members.iter().copied()))
        })
    }
}
