//! The expressions of a model file: reading them, their dimensions, their values.
//!
//! Everything is evaluated in SI units. A number may carry a unit, which follows it at once or after a blank:
//! `80 deg`, `25 mm`, `9.81 m/s^2`, `5 N m`, `2 kg m²`. What follows a number in this way is always a unit;
//! products with a name are written with `*`.
//!
//! Units go on after a blank, `*` or `/`, each with a whole exponent. After `*` or `/` a name that is no unit
//! ends the unit: `3 N*arm`. One that is both a unit and a name of the model is refused, with both ways to
//! write it; only a slash without blanks always goes on with a unit, so that `9.81 m/s^2` means what it says
//! beside a coordinate `s`. Units are `m dm cm mm um µm km in ft`, `kg g mg Mg lb oz`, `s ms min`,
//! `N mN kN MN lbf ozf kgf`, `Nm kNm J kJ`, `W kW hp`, `Pa kPa MPa GPa psi`, `rad mrad deg °`, `Hz rpm` and `%`. Hz
//! counts as 1/s, rpm as 2π/60 1/s; `lb` and `oz` are masses.
//!
//! | part | meaning |
//! |---|---|
//! | `+ - * /`, `^`, `( )` | as usual; `^` binds tighter than a sign and to the right: `-2^2` is -4, `2^3^2` is 512 |
//! | `x²`, `2 · x`, `−x` | superscripts, the dot and the minus sign of Unicode stand for `^`, `*` and `-` |
//! | `sin cos tan asin acos atan sinh cosh tanh exp ln log10` | functions of a pure number or an angle in radian |
//! | `atan2(y, x)`, `hypot(x, y)` | angle and length of the vector (x, y) |
//! | `sqrt abs`, `min(x, y, ...)`, `max(x, y, ...)` | keep the dimension (`sqrt` halves it) |
//! | `sign(x)` | -1, 0 or 1 |
//! | `step(x)` | 0 for x < 0, else 1 |
//! | `NAME(x)` | the table NAME of the model at x |
//! | `pi`, `t` | the number, the time |
//! | `rate(q)` | rate of change of the coordinate `q` |
//!
//! ```
//! use slideway::expression::{Names, Values, parse};
//!
//! let mut names = Names::new();
//! names.parameter("l");
//! names.coordinate("phi");
//! let height = parse("l*sin(phi) + 25 mm", &names).unwrap();
//! let values = Values { coordinates: &[0.0], ..Values::of_parameters(&[2.0]) };
//! assert_eq!(height.evaluate(&values), Ok(0.025));
//! ```

mod decimal;
mod degree;
mod dimension;
mod evaluate;
mod fault;
mod function;
mod inference;
mod lexer;
mod literal;
mod names;
mod parser;
mod program;
mod range;
mod relation;
mod table;
mod unit;

pub use degree::Degree;
pub use dimension::{Dimension, Inferred};
pub use evaluate::Values;
pub use fault::{ExpressionFault, ExpressionFaultKind};
pub(crate) use literal::{written_unit, written_units};
pub use names::{Names, Symbol, is_reserved, is_valid_name};
pub use parser::{MAX_DEPTH, MAX_LENGTH, parse};
pub use program::Expression;
pub(crate) use range::{TO, ends_of_range};
pub(crate) use relation::{Piece, RelationKind};
pub(crate) use slideway_modes::names::all_nearest as nearest_names;
pub(crate) use table::End;
pub use table::{Beyond, Entry, Table};
pub(crate) use unit::WrittenUnit;
