//! A scene from bytes: triangles and wires in groups, and the assumptions that the kernel is given.

use hlr_mesh::topology::topology;
use hlr_visibility::scan::mesh::{DRAWN, OUTLINE};

use super::bytes::Bytes;

const MOST_POINTS: usize = 16;
const MOST_TRIANGLES: usize = 48;
const MOST_WIRES: usize = 8;

#[derive(Debug)]
pub struct Scene {
    pub points: Vec<[f64; 3]>,
    pub triangles: Vec<[i32; 3]>,
    pub triangle_group: Vec<i32>,
    pub edges: Vec<[i32; 2]>,
    pub offsets: Vec<i32>,
    pub incident: Vec<i32>,
    pub edge_group: Vec<i32>,
    pub role: Vec<u8>,
    pub cull: Vec<bool>,
    pub sound: Vec<bool>,
    pub delta: Vec<f64>,
    pub cap: Vec<f64>,
    pub tight: Vec<bool>,
    /// Edges know their triangles, and no edge belongs to two groups: as real scenes are made.
    pub proper: bool,
}

impl Scene {
    /// One input in eight is not proper: anything goes that the entry from Python lets pass.
    pub fn read(bytes: &mut Bytes) -> Scene {
        let proper = !bytes.byte().is_multiple_of(8);
        let (flat, deep) = (bytes.numbers(), bytes.numbers());
        let places = 1 + bytes.below(MOST_POINTS);
        let groups = 1 + bytes.below(3);
        let mut points: Vec<[f64; 3]> =
            (0..places).map(|_| [bytes.number(flat), bytes.number(flat), bytes.number(deep)]).collect();
        // Every group has vertices of its own, in the same places.
        for _ in 1..groups {
            points.extend_from_within(..places);
        }
        let mut scene = Scene {
            points,
            triangles: Vec::new(),
            triangle_group: Vec::new(),
            edges: Vec::new(),
            offsets: Vec::new(),
            incident: Vec::new(),
            edge_group: Vec::new(),
            role: Vec::new(),
            cull: (0..groups).map(|_| bytes.byte().is_multiple_of(4)).collect(),
            sound: (0..groups).map(|_| bytes.bit()).collect(),
            delta: Vec::new(),
            cap: Vec::new(),
            tight: (0..groups).map(|_| bytes.byte().is_multiple_of(4)).collect(),
            proper,
        };
        let unit = scene.points.iter().map(|p| p[2].abs()).fold(0.0, f64::max) / 16.0;
        for _ in 0..groups {
            scene.delta.push(unit * f64::from(bytes.byte() % 4));
            scene.cap.push(unit * f64::from(bytes.byte() % 8));
        }
        for _ in 0..bytes.below(MOST_TRIANGLES + 1) {
            let group = bytes.below(groups);
            let own = if proper { group } else { bytes.below(groups) };
            scene.triangles.push([0; 3].map(|_: i32| (own * places + bytes.below(places)) as i32));
            scene.triangle_group.push(group as i32);
        }
        scene.connect(bytes, places, groups);
        scene.role = scene.edges.iter().map(|_| [DRAWN, DRAWN, OUTLINE, 0][bytes.below(4)]).collect();
        scene
    }

    fn connect(&mut self, bytes: &mut Bytes, places: usize, groups: usize) {
        let found = topology(&self.triangles, self.points.len());
        (self.edges, self.offsets, self.incident) = (found.edges, found.offsets, found.incident);
        self.edge_group = self.edges.iter().map(|e| e[0] / places as i32).collect();
        for _ in 0..bytes.below(MOST_WIRES + 1) {
            let group = bytes.below(groups);
            self.edges.push([0; 2].map(|_: i32| (group * places + bytes.below(places)) as i32));
            self.offsets.push(self.incident.len() as i32);
            self.edge_group.push(group as i32);
        }
        if self.proper {
            return;
        }
        for group in &mut self.edge_group {
            *group = bytes.below(groups) as i32;
        }
        if !self.triangles.is_empty() && bytes.bit() {
            for t in &mut self.incident {
                *t = bytes.below(self.triangles.len()) as i32;
            }
            for at in &mut self.offsets {
                *at = bytes.below(self.incident.len() + 1) as i32;
            }
            self.offsets.sort_unstable();
        }
    }
}
