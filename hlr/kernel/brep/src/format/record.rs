//! Writes down in binary what is read, so that whatever is read as text can be kept, and read again, as a dump.
//!
//! Left out is what a dump without triangles leaves out: triangles of faces that have a surface, and polygons on them.

use super::orientation::Orientation;
use super::tokens::{FLAGS, Read, Table, Tokens};

/// A table in binary: how many items it has, and where its bytes begin.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    pub count: usize,
    pub begin: usize,
}

/// The tables of a dump in binary, as bytes one after another.
#[derive(Default)]
pub struct Recorded {
    pub bytes: Vec<u8>,
    pub sections: Vec<Section>,
    /// Where numbers of items of tables stand in the bytes.
    pub marks: Vec<(usize, Table)>,
    /// Where each triangulation begins.
    pub triangulations: Vec<usize>,
}

pub struct Recorder<T> {
    pub read: T,
    pub recorded: Recorded,
    /// What is read now is left out.
    muted: bool,
}

impl<T> Recorder<T> {
    pub fn new(read: T) -> Recorder<T> {
        Recorder { read, recorded: Recorded::default(), muted: false }
    }

    fn put(&mut self, bytes: &[u8]) {
        if !self.muted {
            self.recorded.bytes.extend(bytes);
        }
    }

    fn put_number(&mut self, number: i32, table: Table) {
        if !self.muted && number != 0 {
            self.recorded.marks.push((self.recorded.bytes.len(), table));
        }
        self.put(&number.to_le_bytes());
    }

    fn put_reals(&mut self, reals: &[f64]) {
        reals.iter().for_each(|real| self.put(&real.to_le_bytes()));
    }
}

impl<T: Tokens> Tokens for Recorder<T> {
    fn at(&self) -> usize {
        self.read.at()
    }

    fn holds(&self, count: usize, size: usize) -> bool {
        self.read.holds(count, size)
    }

    fn header(&mut self, table: Table, size: usize) -> Read<usize> {
        let count = self.read.header(table, size)?;
        let kept = if table == Table::OnTriangles { 0 } else { count };
        self.recorded.sections.push(Section { count: kept, begin: self.recorded.bytes.len() });
        Ok(count)
    }

    fn kind(&mut self) -> Read<u8> {
        let kind = self.read.kind()?;
        self.put(&[kind]);
        Ok(kind)
    }

    fn flag(&mut self) -> Read<bool> {
        let flag = self.read.flag()?;
        self.put(&[u8::from(flag)]);
        Ok(flag)
    }

    fn short(&mut self) -> Read<usize> {
        let short = self.read.short()?;
        self.put(&u16::try_from(short).unwrap_or(u16::MAX).to_le_bytes());
        Ok(short)
    }

    fn integer(&mut self) -> Read<i32> {
        let integer = self.read.integer()?;
        self.put(&integer.to_le_bytes());
        Ok(integer)
    }

    fn real(&mut self) -> Read<f64> {
        let real = self.read.real()?;
        self.put(&real.to_le_bytes());
        Ok(real)
    }

    fn number(&mut self, table: Table) -> Read<i32> {
        let number = self.read.number(table)?;
        self.put_number(number, table);
        Ok(number)
    }

    fn direction<const N: usize>(&mut self) -> Read<[f64; N]> {
        let direction = self.read.direction::<N>()?;
        self.put_reals(&direction);
        Ok(direction)
    }

    fn axes(&mut self, either: bool) -> Read<[[f64; 3]; 3]> {
        let axes = self.read.axes(either)?;
        self.put_reals(axes.as_flattened());
        Ok(axes)
    }

    fn plane_axes(&mut self) -> Read<[[f64; 2]; 2]> {
        let axes = self.read.plane_axes()?;
        self.put_reals(axes.as_flattened());
        Ok(axes)
    }

    fn placement(&mut self) -> Read<[[f64; 4]; 3]> {
        let placement = self.read.placement()?;
        self.put_reals(placement.as_flattened());
        Ok(placement)
    }

    fn skip_polygon_on_triangles(&mut self) -> Read<()> {
        self.read.skip_polygon_on_triangles()
    }

    fn triangulation(&mut self) -> Read<(usize, usize, bool, bool)> {
        let (nodes, triangles, has_uv, has_normals) = self.read.triangulation()?;
        self.recorded.triangulations.push(self.recorded.bytes.len());
        self.put(&(nodes as i32).to_le_bytes());
        self.put(&(triangles as i32).to_le_bytes());
        self.put(&[u8::from(has_uv), 0]);
        self.put_reals(&[0.0]);
        Ok((nodes, triangles, has_uv, has_normals))
    }

    fn skip_normals(&mut self, count: usize) -> Read<()> {
        self.read.skip_normals(count)
    }

    fn shape(&mut self) -> Read<u8> {
        let kind = self.read.shape()?;
        self.put(&[kind]);
        Ok(kind)
    }

    fn place(&mut self) -> Read<(u8, f64)> {
        let (kind, parameter) = self.read.place()?;
        self.put(&[kind]);
        if kind != 0 {
            self.put_reals(&[parameter]);
        }
        Ok((kind, parameter))
    }

    fn representation(&mut self) -> Read<u8> {
        let kind = self.read.representation()?;
        self.muted = matches!(kind, 6 | 7);
        self.put(&[kind]);
        Ok(kind)
    }

    fn continuity(&mut self) -> Read<u8> {
        let order = self.read.continuity()?;
        self.put(&[order]);
        Ok(order)
    }

    fn skip_ends(&mut self) -> Read<()> {
        self.read.skip_ends()
    }

    fn own_triangles(&mut self, surface: bool) -> Read<i32> {
        let number = self.read.own_triangles(surface)?;
        if surface || number == 0 {
            self.put(&[1]);
        } else {
            self.put(&[2]);
            self.put_number(number, Table::Triangulations);
        }
        Ok(number)
    }

    fn flags(&mut self) -> Read<[bool; FLAGS]> {
        let flags = self.read.flags()?;
        self.put(&flags.map(u8::from));
        Ok(flags)
    }

    fn orientation(&mut self) -> Read<Option<Orientation>> {
        let orientation = self.read.orientation()?;
        self.put(&[orientation.map_or(b'*', |orientation| orientation as u8)]);
        Ok(orientation)
    }
}
