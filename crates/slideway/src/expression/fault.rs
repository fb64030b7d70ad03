//! Kinds of fault in an expression.

use std::ops::Range;

use super::dimension::Dimension;
use super::literal::nearest_units;
use super::names::Symbol;

/// A fault of an expression and its place in the text.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{kind}")]
pub struct ExpressionFault {
    /// Kind of fault; its text is the message.
    pub kind: ExpressionFaultKind,
    /// Where: byte offsets into the text of the expression.
    pub span: Range<usize>,
}

impl ExpressionFault {
    pub(super) fn new(kind: ExpressionFaultKind, span: Range<usize>) -> Self {
        Self { kind, span }
    }

    /// A proposal for putting it right, where there is one.
    ///
    /// ```
    /// use slideway::expression::{Names, parse};
    ///
    /// let mut names = Names::new();
    /// names.parameter("length");
    /// let faults = parse("2*lenght", &names).unwrap_err();
    /// assert_eq!(faults[0].to_string(), "unknown name `lenght`");
    /// assert_eq!(faults[0].hint().as_deref(), Some("did you mean `length`?"));
    /// ```
    pub fn hint(&self) -> Option<String> {
        self.kind.hint()
    }
}

/// Kind of fault in an expression, with its values.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExpressionFaultKind {
    /// There is nothing but blanks.
    #[error("the expression is empty")]
    Empty,
    /// The text is longer than any sensible expression.
    #[error("the expression has {length} bytes, more than the {limit} allowed")]
    TooLong {
        /// Bytes in the text.
        length: usize,
        /// Bytes allowed.
        limit: usize,
    },
    /// Parentheses, signs and operators are nested too deeply.
    #[error("the expression is nested more than {limit} levels deep")]
    TooDeep {
        /// Levels allowed.
        limit: usize,
    },
    /// A character that no expression contains.
    #[error("unexpected character `{character}`")]
    UnexpectedCharacter {
        /// The character.
        character: char,
    },
    /// A number that a 64-bit floating-point number cannot hold.
    #[error("the number is too large")]
    NumberTooLarge,
    /// The text stops where a number, name or `(` must follow.
    #[error("the expression ends where a number, a name or `(` is expected")]
    UnexpectedEnd,
    /// Something else stands where a number, name or `(` must.
    #[error("expected a number, a name or `(`, found `{found}`")]
    ExpectedOperand {
        /// Text that stands there.
        found: String,
    },
    /// Two parts follow each other with nothing between them.
    #[error("expected an operator, found `{found}`")]
    ExpectedOperator {
        /// Text that stands there.
        found: String,
    },
    /// A `(` that nothing closes.
    #[error("this `(` is never closed")]
    UnclosedParenthesis,
    /// A `)` that closes nothing.
    #[error("this `)` has no matching `(`")]
    UnmatchedParenthesis,
    /// A name that is neither reserved nor one of the model's.
    #[error("unknown name `{name}`")]
    UnknownName {
        /// The name.
        name: String,
        /// The known name most like it.
        nearest: Option<String>,
        /// Whether a unit has this name.
        is_unit: bool,
    },
    /// Something called as a function that is none.
    #[error("unknown function `{name}`")]
    UnknownFunction {
        /// The name.
        name: String,
        /// The function most like it.
        nearest: Option<String>,
        /// Whether the model has something of this name.
        is_name: bool,
    },
    /// A function's name without the arguments.
    #[error("the function `{name}` needs arguments in parentheses")]
    FunctionWithoutArguments {
        /// The function.
        name: String,
    },
    /// Too few or too many arguments.
    #[error("`{function}` takes {expected}, not {found}")]
    WrongArgumentCount {
        /// The function.
        function: String,
        /// How many it takes, in words.
        expected: &'static str,
        /// How many there are.
        found: usize,
    },
    /// `rate(...)` of something else than the name of a coordinate.
    #[error("`rate` takes the name of one coordinate")]
    RateArgument,
    /// `rate(...)` of a parameter or of time.
    #[error("`{name}` is not a coordinate and has no rate")]
    NotACoordinate {
        /// The name.
        name: String,
        /// The coordinate most like it.
        nearest: Option<String>,
    },
    /// Something that follows a number and is no unit.
    #[error("unknown unit `{unit}`")]
    UnknownUnit {
        /// Text that stands there.
        unit: String,
        /// The units most like it.
        nearest: Vec<&'static str>,
        /// Whether an expression may use it as a name or function.
        is_name: bool,
    },
    /// After a unit and `*` or `/`, a name that could be another unit or something of the model.
    #[error("`{name}` could be the unit or the model's `{name}`")]
    AmbiguousUnit {
        /// The name.
        name: String,
        /// How to write it if the model's is meant.
        as_name: String,
        /// How to write it if the unit is meant.
        as_unit: String,
    },
    /// An exponent of a unit that is not a whole number between -127 and 127.
    #[error("the exponent of a unit must be a whole number between -127 and 127")]
    UnitExponent,
    /// A sum, difference, comparison or the like of two dimensions.
    #[error("`{operation}` cannot combine {left} and {right}")]
    DimensionMismatch {
        /// The operator or function.
        operation: &'static str,
        /// Dimension of its first argument.
        left: Dimension,
        /// Dimension of its second argument.
        right: Dimension,
    },
    /// A function of pure numbers applied to something with a dimension.
    #[error("`{function}` takes an angle or pure number, not {found}")]
    NotDimensionless {
        /// The function.
        function: &'static str,
        /// Dimension of its argument.
        found: Dimension,
    },
    /// A table asked for the value at something of another dimension.
    #[error("the table `{table}` expects {wanted}, not {found}")]
    TableArgument {
        /// The table.
        table: String,
        /// Dimension of its arguments.
        wanted: Dimension,
        /// Dimension of the argument.
        found: Dimension,
    },
    /// An exponent with a dimension.
    #[error("an exponent must be a pure number, not {found}")]
    ExponentDimension {
        /// Dimension of the exponent.
        found: Dimension,
    },
    /// A power or root of a quantity that has no dimension.
    #[error("{base} to the power {exponent} has no meaningful dimension")]
    FractionalPower {
        /// Dimension of the base.
        base: Dimension,
        /// The exponent.
        exponent: f64,
    },
    /// A quantity with a dimension to a power that is not a constant.
    #[error("{base} to a power that varies has no fixed dimension")]
    VariablePower {
        /// Dimension of the base.
        base: Dimension,
    },
    /// The exponents of the dimension leave the range from -128 to 127.
    #[error("the exponents of the dimension are too large")]
    DimensionTooLarge,
    /// Three dots where two stand between the ends of a range.
    #[error("a range has two dots between its ends, not three")]
    ThreeDots,
    /// A division by zero.
    #[error("division by zero: {numerator} / 0")]
    DivisionByZero {
        /// Dividend.
        numerator: f64,
    },
    /// An operation that has no value, or one too large, for these arguments.
    #[error("`{operation}` has no finite value for {}", listed(.arguments))]
    NotFinite {
        /// The operator or function.
        operation: String,
        /// Its arguments.
        arguments: Vec<f64>,
    },
    /// The value given for a name is infinite or not a number.
    #[error("the value {value} is not finite")]
    ValueNotFinite {
        /// The value.
        value: f64,
    },
    /// No value was given for a name.
    #[error("no value is given for {symbol:?}")]
    MissingValue {
        /// Symbol for which the name stands.
        symbol: Symbol,
    },
}

impl ExpressionFaultKind {
    /// Returns a hint for mending the fault, or `None` if there is nothing to say.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::UnexpectedCharacter { character } => character_hint(*character),
            Self::ExpectedOperand { found } if found == "*" => Some("write `^` for a power".to_owned()),
            Self::ExpectedOperator { found } if found == "," => {
                Some("write decimals with a point, as in 1.5".to_owned())
            }
            Self::ExpectedOperator { found } if found == "1" => Some(
                "a unit follows its number without a 1, as in `300/min` or `300 rpm`; write `*` to multiply"
                    .to_owned(),
            ),
            Self::ExpectedOperator { .. } | Self::UnknownFunction { is_name: true, .. } => {
                Some(MULTIPLY.to_owned())
            }
            Self::UnknownName { name, is_unit: true, .. } => {
                Some(format!("`{name}` is a unit: it must follow a number, as in `1 {name}`"))
            }
            Self::UnknownName { nearest, .. } | Self::NotACoordinate { nearest, .. } => {
                nearest.as_deref().map(did_you_mean)
            }
            Self::UnknownFunction { nearest, .. } => nearest.as_deref().map(did_you_mean),
            Self::UnknownUnit { unit, nearest, is_name } => unit_hint(unit, nearest, *is_name),
            Self::AmbiguousUnit { name, as_name, as_unit } => {
                Some(format!("write `{as_name}` for the model's `{name}`, `{as_unit}` for the unit"))
            }
            Self::UnitExponent => {
                Some("use parentheses to raise the whole quantity to a power, as in `(2 m)^x`".to_owned())
            }
            Self::DimensionMismatch { .. } => Some("give every term the same kind of unit".to_owned()),
            Self::NotFinite { operation, arguments } => domain_hint(operation, arguments).map(str::to_owned),
            _ => None,
        }
    }
}

const MULTIPLY: &str = "write `*` to multiply";
/// Of `t`, which stands for the time where it is no unit.
const TIME: &str = "; to multiply, write `*`";

fn did_you_mean(name: &str) -> String {
    format!("did you mean `{name}`?")
}

fn character_hint(character: char) -> Option<String> {
    let hint = match character {
        '\u{221a}' => "write `sqrt(...)` for a square root",
        '[' | ']' | '{' | '}' => "use `(` and `)` only",
        '\u{f7}' | ':' => "write `/` to divide",
        ';' => "separate arguments with `,`",
        _ => return None,
    };
    Some(hint.to_owned())
}

impl ExpressionFaultKind {
    /// Proposes units of this dimension for one that is not known, if one of them is like it.
    pub(crate) fn propose_units(&mut self, dimension: Dimension) {
        if let Self::UnknownUnit { unit, nearest, .. } = self {
            let fitting = nearest_units(unit, |of_unit| of_unit == dimension);
            if !fitting.is_empty() {
                *nearest = fitting;
            }
        }
    }
}

fn unit_hint(unit: &str, nearest: &[&str], is_name: bool) -> Option<String> {
    if matches!(unit, "t" | "ton" | "tons" | "tonne" | "tonnes") {
        return Some(format!("write a tonne as `1 Mg` or `1000 kg`{}", if is_name { TIME } else { "" }));
    }
    if is_name {
        return Some(MULTIPLY.to_owned());
    }
    let exponent = unit.strip_prefix(['e', 'E']);
    if exponent.is_some_and(|digits| digits.chars().all(|digit| digit.is_ascii_digit())) {
        return Some("an exponent needs digits, and no space before it, as in `1e3`".to_owned());
    }
    if nearest.is_empty() {
        return None;
    }
    let quoted: Vec<String> = nearest.iter().map(|name| format!("`{name}`")).collect();
    Some(format!("did you mean {}?", quoted.join(" or ")))
}

fn domain_hint(operation: &str, arguments: &[f64]) -> Option<&'static str> {
    match (operation, arguments) {
        ("sqrt", [x]) if *x < 0.0 => Some("a square root needs an argument that is not negative"),
        ("ln" | "log10", [x]) if *x <= 0.0 => Some("a logarithm needs a positive argument"),
        ("asin" | "acos", [_]) => Some("the argument must lie between -1 and 1"),
        ("^", [base, _]) if *base == 0.0 => Some("zero has no negative power"),
        ("^", [base, power]) if *base < 0.0 && power.fract() != 0.0 => {
            Some("a negative base needs a whole exponent")
        }
        _ => None,
    }
}

fn listed(arguments: &[f64]) -> String {
    // More digits than that are rounding to whoever reads them.
    let brief = |argument: &f64| Some(argument.to_string()).filter(|exact| exact.len() <= 10);
    let written =
        arguments.iter().map(|argument| brief(argument).unwrap_or_else(|| format!("{argument:.4e}")));
    written.collect::<Vec<_>>().join(" and ")
}
