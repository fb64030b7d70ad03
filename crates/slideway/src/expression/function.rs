//! Operators and functions of expressions: their names and their values.

use crate::interval::Real;

/// A function or operator of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unary {
    Negate,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Sqrt,
    Abs,
    Sign,
    Exp,
    Ln,
    Log10,
    Step,
}

/// A function or operator of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Atan2,
    Hypot,
    Min,
    Max,
}

/// A function called by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Unary(Unary),
    Binary(Binary),
}

pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("sin", Function::Unary(Unary::Sin)),
    ("cos", Function::Unary(Unary::Cos)),
    ("tan", Function::Unary(Unary::Tan)),
    ("asin", Function::Unary(Unary::Asin)),
    ("acos", Function::Unary(Unary::Acos)),
    ("atan", Function::Unary(Unary::Atan)),
    ("sinh", Function::Unary(Unary::Sinh)),
    ("cosh", Function::Unary(Unary::Cosh)),
    ("tanh", Function::Unary(Unary::Tanh)),
    ("sqrt", Function::Unary(Unary::Sqrt)),
    ("abs", Function::Unary(Unary::Abs)),
    ("sign", Function::Unary(Unary::Sign)),
    ("exp", Function::Unary(Unary::Exp)),
    ("ln", Function::Unary(Unary::Ln)),
    ("log10", Function::Unary(Unary::Log10)),
    ("step", Function::Unary(Unary::Step)),
    ("atan2", Function::Binary(Binary::Atan2)),
    ("hypot", Function::Binary(Binary::Hypot)),
    ("min", Function::Binary(Binary::Min)),
    ("max", Function::Binary(Binary::Max)),
];

pub(super) fn find(name: &str) -> Option<Function> {
    FUNCTIONS.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
}

fn name_of(function: Function) -> &'static str {
    FUNCTIONS.iter().find(|(_, known)| *known == function).map_or("", |(name, _)| name)
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

impl Unary {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Negate => "-",
            named => name_of(Function::Unary(named)),
        }
    }

    /// The value at `x`; not finite outside the function's domain and where it overflows.
    pub(super) fn value<T: Real>(self, x: T) -> T {
        match self {
            Self::Negate => -x,
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Sqrt => x.sqrt(),
            Self::Abs => x.abs(),
            Self::Sign => x.sign_value(),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Log10 => x.log10(),
            Self::Step => x.step(),
        }
    }
}

impl Binary {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Power => "^",
            named => name_of(Function::Binary(named)),
        }
    }

    /// The value at `x` and `y`; not finite outside the function's domain and where it overflows.
    pub(super) fn value<T: Real>(self, x: T, y: T) -> T {
        match self {
            Self::Add => x + y,
            Self::Subtract => x - y,
            Self::Multiply => x * y,
            Self::Divide => x / y,
            Self::Power => x.power(y),
            Self::Atan2 => x.atan2(y),
            Self::Hypot => x.hypot(y),
            Self::Min => x.min(y),
            Self::Max => x.max(y),
        }
    }
}
