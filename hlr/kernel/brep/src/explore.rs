//! Walks the shape tree of every part and lists its faces, its edges, and which face uses which edge.
//!
//! The order is that of TopExp::MapShapes: a number here is an index into the part's face or edge map.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::format::{Damaged, Dump, Kind, MOST_FACTORS, Orientation, Sub, determinant};

/// A face of a part: number of the underlying face, location, and orientation; whether its location makes it a mirror
/// image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlacedFace {
    pub face: u32,
    pub location: u32,
    pub reversed: bool,
    pub mirrored: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlacedEdge {
    pub edge: u32,
    pub location: u32,
}

/// A use of an edge by a wire of a face: numbers within the part. A face that occurs twice uses its edges twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlacedUse {
    pub edge: u32,
    pub face: u32,
    pub orientation: Orientation,
}

#[derive(Clone, Debug, Default)]
pub struct Part {
    pub faces: Vec<PlacedFace>,
    pub edges: Vec<PlacedEdge>,
    pub uses: Vec<PlacedUse>,
    /// Number of solids; one that is placed several times counts each time.
    pub solids: usize,
}

pub struct Explored {
    /// Underlying faces and edges, in the order in which they are met.
    pub faces: Vec<u32>,
    pub edges: Vec<u32>,
    pub parts: Vec<Part>,
}

/// Limit on the shapes of all parts together. A file whose nesting produces more is damaged.
const MOST: usize = 200_000_000;

/// A shape during the walk: the face it belongs to, and its location and orientation relative to the part.
#[derive(Clone, Copy)]
struct Item {
    shape: u32,
    location: u32,
    orientation: Orientation,
    face: Option<u32>,
}

/// The children of the root as parts of one shape each: all, or those with the numbers `chosen`. Locations are numbers of
/// the table.
///
/// # Errors
/// The root is no compound, or a chosen child does not exist.
pub fn children(dump: &Dump, chosen: Option<&[u32]>) -> Result<Vec<Vec<Sub>>, Damaged> {
    let root = &dump.shapes[dump.root.shape as usize];
    if root.kind != Kind::Compound {
        return Err(Damaged { what: "the root is no compound", at: 0, unsupported: false });
    }
    let alone = |sub: &Sub| vec![Sub { location: dump.locations.written(sub.location), ..*sub }];
    let missing = Damaged { what: "a part that there is not", at: 0, unsupported: false };
    match chosen {
        None => Ok(root.subs.iter().map(alone).collect()),
        Some(some) => some.iter().map(|&i| root.subs.get(i as usize).map(alone).ok_or(missing)).collect(),
    }
}

/// Lists the faces and edges of parts, which are one or several shapes each. Locations are numbers of the table.
///
/// # Errors
/// The parts contain too many shapes.
pub fn explore(dump: &mut Dump, parts: &[Vec<Sub>]) -> Result<Explored, Damaged> {
    let mut found = Explored { faces: Vec::new(), edges: Vec::new(), parts: Vec::new() };
    let [mut faces, mut edges] = [0, 1].map(|_| vec![None; dump.shapes.len()]);
    let (mut left, mut stack) = (MOST, Vec::new());
    for shapes in parts {
        let mut part = Part::default();
        let (mut placed_faces, mut placed_edges) = (FxHashMap::default(), FxHashMap::default());
        let mut placed_solids = FxHashSet::default();
        let item =
            |sub: &Sub| Item { shape: sub.shape, location: sub.location, orientation: sub.orientation, face: None };
        stack.extend(shapes.iter().rev().map(item));
        while let Some(item) = stack.pop() {
            left = left.checked_sub(1).ok_or(Damaged {
                what: "shapes nested beyond measure",
                at: 0,
                unsupported: false,
            })?;
            let mut face = item.face;
            match dump.shapes[item.shape as usize].kind {
                Kind::Vertex { .. } => continue,
                Kind::Edge { .. } => {
                    let edge = numbered(&mut edges, &mut found.edges, item.shape);
                    let placed = PlacedEdge { edge, location: item.location };
                    let number = *placed_edges.entry(placed_key(edge, item.location)).or_insert_with(|| {
                        part.edges.push(placed);
                        part.edges.len() as u32 - 1
                    });
                    if let Some(face) = item.face {
                        part.uses.push(PlacedUse { edge: number, face, orientation: item.orientation });
                    }
                    continue;
                }
                Kind::Face { .. } => {
                    let number = numbered(&mut faces, &mut found.faces, item.shape);
                    let reversed = item.orientation == Orientation::Reversed;
                    let mirrored = item.location != 0 && determinant(&dump.locations.matrix(item.location)) < 0.0;
                    let placed = PlacedFace { face: number, location: item.location, reversed, mirrored };
                    face = Some(*placed_faces.entry(placed_key(number, item.location)).or_insert_with(|| {
                        part.faces.push(placed);
                        part.faces.len() as u32 - 1
                    }));
                }
                Kind::Solid => {
                    placed_solids.insert(placed_key(item.shape, item.location));
                }
                _ => {}
            }
            if dump.locations.factors_in_all() > MOST_FACTORS {
                return Err(Damaged { what: "shapes nested beyond measure", at: 0, unsupported: false });
            }
            let subs: &[Sub] = &dump.shapes[item.shape as usize].subs;
            for sub in subs.iter().rev() {
                let within = dump.locations.written(sub.location);
                stack.push(Item {
                    shape: sub.shape,
                    location: dump.locations.product(item.location, within),
                    orientation: item.orientation.compose(sub.orientation),
                    face,
                });
            }
        }
        part.solids = placed_solids.len();
        found.parts.push(part);
    }
    Ok(found)
}

fn placed_key(number: u32, location: u32) -> u64 {
    u64::from(number) << 32 | u64::from(location)
}

fn numbered(known: &mut [Option<u32>], all: &mut Vec<u32>, shape: u32) -> u32 {
    *known[shape as usize].get_or_insert_with(|| {
        all.push(shape);
        all.len() as u32 - 1
    })
}
