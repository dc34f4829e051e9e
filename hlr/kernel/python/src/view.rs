//! Read-only NumPy arrays whose data lie in an object of the kernel: nothing is copied.

use numpy::ndarray::{ArrayView1, ArrayView2, ArrayView3};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::PyClass;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;

pub type Flat<'py, T> = Bound<'py, PyArray1<T>>;
pub type Rows<'py, T> = Bound<'py, PyArray2<T>>;

/// An object whose data never move or change while it lives: frozen, and behind an `Arc` or a `Vec`.
pub trait Holder: PyClass<Frozen = True> + Sync {}

/// (n,)
pub fn flat<'py, C: Holder, T: numpy::Element>(
    owner: &Bound<'py, C>,
    data: impl for<'a> Fn(&'a C) -> &'a [T],
) -> Flat<'py, T> {
    let view = ArrayView1::from(data(owner.get()));
    // SAFETY: the array holds the owner, whose data stay unchanged as long as it lives.
    let array = unsafe { PyArray1::borrow_from_array(&view, owner.clone().into_any()) };
    sealed(array.readwrite().make_nonwriteable());
    array
}

/// (n, N)
pub fn rows<'py, C: Holder, T: numpy::Element, const N: usize>(
    owner: &Bound<'py, C>,
    data: impl for<'a> Fn(&'a C) -> &'a [[T; N]],
) -> Rows<'py, T> {
    let data = data(owner.get());
    let shape = (data.len(), N);
    let view = ArrayView2::from_shape(shape, data.as_flattened()).expect("rows of N");
    // SAFETY: as above.
    let array = unsafe { PyArray2::borrow_from_array(&view, owner.clone().into_any()) };
    sealed(array.readwrite().make_nonwriteable());
    array
}

/// (n, 3, 4)
pub fn matrices<'py, C: Holder>(
    owner: &Bound<'py, C>,
    data: impl for<'a> Fn(&'a C) -> &'a [[[f64; 4]; 3]],
) -> Bound<'py, PyArray3<f64>> {
    let data = data(owner.get());
    let shape = (data.len(), 3, 4);
    let view = ArrayView3::from_shape(shape, data.as_flattened().as_flattened()).expect("matrices");
    // SAFETY: as above.
    let array = unsafe { PyArray3::borrow_from_array(&view, owner.clone().into_any()) };
    sealed(array.readwrite().make_nonwriteable());
    array
}

/// Ends the borrow; the array stays read-only.
fn sealed<T: numpy::Element, D: numpy::ndarray::Dimension>(_: numpy::PyReadonlyArray<'_, T, D>) {}

/// Getters of arrays that a class holds: name, how the array is shown, and where it is. The other methods of the class
/// follow.
macro_rules! arrays {
    ($class:ident { $($name:ident: $show:ident $kind:ty = $get:expr;)* } $($methods:tt)*) => {
        impl $crate::view::Holder for $class {}

        #[pymethods]
        impl $class {
            $(
                #[getter]
                fn $name<'py>(slf: &Bound<'py, Self>) -> $kind {
                    $show(slf, $get)
                }
            )*

            $($methods)*
        }
    };
}
pub(crate) use arrays;
