//! Operators and functions of expressions: their names and their values.

use crate::interval::Real;

/// Declares operators and functions of so many arguments: the sign or the name of each in an expression, and its value, not finite
/// outside its domain and where it overflows.
macro_rules! functions {
    ($(#[$about:meta])* $kind:ident($($x:ident),+): $($operator:ident $sign:literal $operated:expr),+;
     $($member:ident $name:literal $value:expr;)+) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum $kind {
            $($operator,)+
            $($member),+
        }

        impl $kind {
            /// Those that are called by their names.
            const NAMED: &[Self] = &[$(Self::$member),+];

            pub(super) fn name(self) -> &'static str {
                match self {
                    $(Self::$operator => $sign,)+
                    $(Self::$member => $name),+
                }
            }

            /// The value, not finite outside the function's domain and where it overflows.
            pub(super) fn value<T: Real>(self, $($x: T),+) -> T {
                match self {
                    $(Self::$operator => $operated,)+
                    $(Self::$member => $value),+
                }
            }
        }
    };
}

functions! {
    /// A function or operator of one argument.
    Unary(x): Negate "-" -x;
    Sin "sin" x.sin();
    Cos "cos" x.cos();
    Tan "tan" x.tan();
    Asin "asin" x.asin();
    Acos "acos" x.acos();
    Atan "atan" x.atan();
    Sinh "sinh" x.sinh();
    Cosh "cosh" x.cosh();
    Tanh "tanh" x.tanh();
    Sqrt "sqrt" x.sqrt();
    Abs "abs" x.abs();
    Sign "sign" x.sign_value();
    Exp "exp" x.exp();
    Ln "ln" x.ln();
    Log10 "log10" x.log10();
    Step "step" x.step();
}

functions! {
    /// A function or operator of two arguments.
    Binary(x, y): Add "+" x + y, Subtract "-" x - y, Multiply "*" x * y, Divide "/" x / y, Power "^" x.power(y);
    Atan2 "atan2" x.atan2(y);
    Hypot "hypot" x.hypot(y);
    Min "min" x.min(y);
    Max "max" x.max(y);
}

/// A function called by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Unary(Unary),
    Binary(Binary),
}

/// All functions, each with its name.
pub(super) fn named() -> impl Iterator<Item = (&'static str, Function)> {
    let unary = Unary::NAMED.iter().map(|function| (function.name(), Function::Unary(*function)));
    unary.chain(Binary::NAMED.iter().map(|function| (function.name(), Function::Binary(*function))))
}

pub(super) fn find(name: &str) -> Option<Function> {
    named().find(|(known, _)| *known == name).map(|(_, function)| function)
}

impl Function {
    /// Whether this many arguments make sense; `min` and `max` take two or more.
    pub(super) fn takes(self, count: usize) -> bool {
        match self {
            Self::Unary(_) => count == 1,
            Self::Binary(Binary::Min | Binary::Max) => count >= 2,
            Self::Binary(_) => count == 2,
        }
    }

    pub(super) fn expected_count(self) -> &'static str {
        match self {
            Self::Unary(_) => "one argument",
            Self::Binary(Binary::Min | Binary::Max) => "two or more arguments",
            Self::Binary(_) => "two arguments",
        }
    }
}
