//! Curves as the columns of `hlr.source.model.Curves`.

use hlr_brep::geometry::curve::Curve;

const TURN: [f64; 2] = [0.0, std::f64::consts::TAU];

/// Records of curves one after another; kind 0 where there is none.
pub struct CurveColumns {
    pub kind: Vec<u8>,
    pub range: Vec<[f64; 2]>,
    pub offsets: Vec<i32>,
    pub values: Vec<f64>,
}

impl CurveColumns {
    pub fn of<'a>(curves: impl Iterator<Item = Option<&'a Curve>>) -> CurveColumns {
        let mut out = CurveColumns { kind: Vec::new(), range: Vec::new(), offsets: vec![0], values: Vec::new() };
        for curve in curves {
            let range = |c: &Curve| if let Curve::Spline(n) = c { n.domain().into() } else { TURN };
            out.range.push(curve.map_or([0.0; 2], range));
            out.kind.push(curve.map_or(0, |c| c.record(&mut out.values)));
            out.offsets.push(out.values.len() as i32);
        }
        out
    }
}
