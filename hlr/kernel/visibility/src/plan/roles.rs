//! Which edges are drawn, and what the pass is told of all groups.

use hlr_mesh::groups::Groups;
use rayon::prelude::*;

use super::contact::Contact;
use crate::scan::mesh::{DRAWN, OUTLINE};
use crate::scan::scene::Group;

/// The role of an edge by its class: beside no curved face, then beside one.
pub type Roles = [[u8; 256]; 2];

/// drawn: classes of which edges are drawn; goes_on: classes of edges across which a curved face goes on, and may fold
/// over. Classes beyond their lengths are none of them.
pub fn roles(drawn: &[bool], goes_on: &[bool]) -> Roles {
    let of = |listed: &[bool], kind: usize, role: u8| if listed.get(kind) == Some(&true) { role } else { 0 };
    let beside = |curved: bool| {
        std::array::from_fn(|kind| of(drawn, kind, DRAWN) | if curved { of(goes_on, kind, OUTLINE) } else { 0 })
    };
    [beside(false), beside(true)]
}

/// The role of each edge. curved: a curved face may show its outline there; kind: the edge's class; hidden: edges that
/// their own body hides have no role.
pub fn edge_roles(curved: &[bool], kind: &[u8], roles: &Roles, hidden: &[bool]) -> Vec<u8> {
    let role = |(&curved, &kind): (&bool, &u8)| roles[usize::from(curved)][usize::from(kind)];
    let mut out: Vec<u8> = curved.par_iter().with_min_len(1 << 16).zip(kind).map(role).collect();
    out.iter_mut().zip(hidden).filter(|(_, hidden)| **hidden).for_each(|(role, _)| *role = 0);
    out
}

/// What the pass is told of each group.
pub fn told(groups: &Groups, contact: &Contact) -> Vec<Group> {
    let group = |g: usize| Group {
        cull: groups.cull[g],
        sound: groups.sound[g],
        delta: contact.delta[g],
        cap: contact.cap[g],
        tight: groups.tight[g],
    };
    (0..groups.len()).map(group).collect()
}

/// Numbers that decide which steps the pass takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Groups that have triangles.
    pub faced: usize,
    /// Groups whose faces are culled where they are turned away.
    pub culled: usize,
    /// Groups that may pass through themselves; and those among them that are not culled.
    pub unsound: usize,
    pub unsound_not_culled: usize,
    /// Edges that have a role.
    pub edges: usize,
}

pub fn counts(groups: &Groups, triangle_group: &[i32], role: &[u8]) -> Counts {
    let mut faced = vec![false; groups.len()];
    triangle_group.iter().for_each(|&g| faced[g as usize] = true);
    let unsound = || (0..groups.len()).filter(|&g| groups.used(g) && !groups.sound[g]);
    Counts {
        faced: faced.iter().filter(|faced| **faced).count(),
        culled: groups.cull.iter().filter(|cull| **cull).count(),
        unsound: unsound().count(),
        unsound_not_culled: unsound().filter(|&g| !groups.cull[g]).count(),
        edges: role.iter().filter(|role| **role != 0).count(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::contact::tests::boxes;
    use super::*;

    #[test]
    fn edges_have_the_role_of_their_class() {
        let mut goes_on = [false; 256];
        (goes_on[3], goes_on[255]) = (true, true);
        let roles = roles(&[false, true, false, true], &goes_on);
        assert_eq!((roles[0][1], roles[1][1], roles[0][255], roles[1][0]), (1, 1, 0, 0));
        let (curved, kind) = ([false, true, true, false, true], [3, 3, 255, 255, 3]);
        assert_eq!(edge_roles(&curved, &kind, &roles, &[]), [1, 3, 2, 0, 3]);
        assert_eq!(edge_roles(&curved, &kind, &roles, &[false, true, false, false, false]), [1, 0, 2, 0, 3]);
    }

    #[test]
    fn groups_are_counted() {
        let mut groups = boxes([[[0.0; 3], [1.0; 3]]; 4]);
        (groups.sound[0], groups.sound[1], groups.sound[3]) = (false, false, false);
        groups.cull[1] = false;
        groups.low[3] = [f64::INFINITY; 3];
        let found = counts(&groups, &[0, 2, 2], &[0, 1, 2]);
        assert_eq!(found, Counts { faced: 2, culled: 3, unsound: 2, unsound_not_culled: 1, edges: 2 });
    }
}
