//! A number that records what is done to it, and writes it down as a script for Gappa.
//!
//! Every operation is a node with three meanings: what it computes, `t`, a rounded `tx`; what it stands for in exact
//! arithmetic, `e`; and the deviation t − e, a sum of rounding errors t − tx with a factor each. The residual of a sum
//! or product is −(t − tx) and stands for 0. The deviation of the result is the hint that Gappa needs, since it sees no
//! cancellation on its own; it checks that the two are the same polynomial.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::{Add, Mul, Neg, Sub};

use super::double::{Double, Number};

/// Monomials, each a sorted product of names, and their factors.
type Polynomial = BTreeMap<Vec<String>, i64>;

/// Factor of each rounding error, by its node.
type Deviation = BTreeMap<usize, Polynomial>;

struct Node {
    /// `t` and, unless it is 0, `e`.
    name: String,
    exact: Option<String>,
    deviation: Deviation,
    /// Terms of a sum, with their signs: to expand it.
    terms: Vec<Symbolic>,
}

thread_local! {
    static NODES: RefCell<Vec<Node>> = const { RefCell::new(Vec::new()) };
    static LINES: RefCell<String> = const { RefCell::new(String::new()) };
}

/// A node or its opposite: negation is exact.
#[derive(Clone, Copy)]
pub struct Symbolic {
    node: usize,
    negative: bool,
}

fn push(node: Node) -> Symbolic {
    NODES.with_borrow_mut(|nodes| {
        nodes.push(node);
        Symbolic { node: nodes.len() - 1, negative: false }
    })
}

fn line(text: &str) {
    LINES.with_borrow_mut(|lines| {
        lines.push_str(text);
        lines.push('\n');
    });
}

fn accumulate(sum: &mut Deviation, deviation: &Deviation, factor: Option<&str>, negative: bool) {
    for (&node, polynomial) in deviation {
        let entry = sum.entry(node).or_default();
        for (monomial, &count) in polynomial {
            let mut monomial = monomial.clone();
            monomial.extend(factor.map(str::to_owned));
            monomial.sort();
            let total = entry.entry(monomial.clone()).or_default();
            *total += if negative { -count } else { count };
            if *total == 0 {
                entry.remove(&monomial);
            }
        }
        if entry.is_empty() {
            sum.remove(&node);
        }
    }
}

impl Symbolic {
    fn name(self) -> String {
        let name = NODES.with_borrow(|nodes| nodes[self.node].name.clone());
        if self.negative { format!("(-{name})") } else { name }
    }

    fn exact(self) -> Option<String> {
        let exact = NODES.with_borrow(|nodes| nodes[self.node].exact.clone());
        exact.map(|exact| if self.negative { format!("(-{exact})") } else { exact })
    }

    fn deviation(self) -> Deviation {
        NODES.with_borrow(|nodes| nodes[self.node].deviation.clone())
    }

    /// The rounded value of `text`, which stands for `exact`.
    fn rounded(text: &str, exact: Option<String>, mut deviation: Deviation, terms: Vec<Self>) -> Self {
        let node = NODES.with_borrow(Vec::len);
        line(&format!("t{node}x = {text}; t{node} = rnd(t{node}x);"));
        let exact = exact.map(|exact| {
            line(&format!("e{node} = {exact};"));
            format!("e{node}")
        });
        deviation.insert(node, Polynomial::from([(Vec::new(), 1)]));
        push(Node { name: format!("t{node}"), exact, deviation, terms })
    }

    fn residual(self) -> Self {
        let node = NODES.with_borrow(Vec::len);
        let name = self.name();
        line(&format!("t{node} = -({name} - {name}x);"));
        let deviation = Deviation::from([(self.node, Polynomial::from([(Vec::new(), -1)]))]);
        push(Node { name: format!("t{node}"), exact: None, deviation, terms: Vec::new() })
    }
}

impl Neg for Symbolic {
    type Output = Self;
    fn neg(self) -> Self {
        Self { negative: !self.negative, ..self }
    }
}

impl Add for Symbolic {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let exact = match (self.exact(), other.exact()) {
            (Some(a), Some(b)) => Some(format!("{a} + {b}")),
            (a, b) => a.or(b),
        };
        let mut deviation = Deviation::new();
        accumulate(&mut deviation, &self.deviation(), None, self.negative);
        accumulate(&mut deviation, &other.deviation(), None, other.negative);
        let text = format!("{} + {}", self.name(), other.name()).replace("+ (-", "- (");
        Self::rounded(&text, exact, deviation, vec![self, other])
    }
}

impl Sub for Symbolic {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Symbolic {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let negative = self.negative != other.negative;
        let (u, v) = (Self { negative: false, ..self }, Self { negative: false, ..other });
        let exact = u.exact().zip(v.exact()).map(|(a, b)| format!("{a} * {b}"));
        // u v − U V = u (v − V) + (u − U) V
        let mut deviation = Deviation::new();
        accumulate(&mut deviation, &v.deviation(), Some(&u.name()), false);
        if let Some(exact) = v.exact() {
            accumulate(&mut deviation, &u.deviation(), Some(&exact), false);
        }
        Self { negative, ..Self::rounded(&format!("{} * {}", u.name(), v.name()), exact, deviation, Vec::new()) }
    }
}

impl Number for Symbolic {
    fn constant(x: f64) -> Self {
        push(Node { name: x.to_string(), exact: Some(x.to_string()), deviation: Deviation::new(), terms: Vec::new() })
    }

    fn sum(a: Self, b: Self) -> Double<Self> {
        let hi = a + b;
        Double { hi, lo: hi.residual() }
    }

    /// The residual is exact by Dekker's theorem, whose condition is no part of the proof.
    fn ordered_sum(a: Self, b: Self) -> Double<Self> {
        Self::sum(a, b)
    }

    fn product(a: Self, b: Self) -> Double<Self> {
        let hi = a * b;
        let lo = Self { negative: false, ..hi }.residual();
        Double { hi, lo: Self { negative: hi.negative, ..lo } }
    }
}

/// One theorem in the making.
pub struct Script {
    title: String,
    hypotheses: Vec<String>,
    hints: Vec<String>,
}

impl Script {
    pub fn new(title: &str) -> Self {
        NODES.with_borrow_mut(Vec::clear);
        LINES.with_borrow_mut(String::clear);
        Self { title: title.to_owned(), hypotheses: Vec::new(), hints: Vec::new() }
    }

    /// Any double of at most `bound`.
    pub fn float(&mut self, name: &str, bound: &str) -> Symbolic {
        self.assume(name, bound);
        self.leaf(name)
    }

    /// A double within `error` of the real number `exact`.
    pub fn float_near(&mut self, name: &str, exact: &str, error: &str) -> Symbolic {
        self.assume(&format!("{name} - {exact}"), error);
        self.hints.push(format!("{name} -> ({name} - {exact}) + {exact};"));
        self.leaf(name)
    }

    fn leaf(&self, name: &str) -> Symbolic {
        line(&format!("{name} = rnd({name}_);"));
        push(Node {
            name: name.to_owned(),
            exact: Some(name.to_owned()),
            deviation: Deviation::new(),
            terms: Vec::new(),
        })
    }

    pub fn zero(&self) -> Symbolic {
        push(Node { name: "0".to_owned(), exact: None, deviation: Deviation::new(), terms: Vec::new() })
    }

    pub fn assume(&mut self, expression: &str, bound: &str) {
        self.hypotheses.push(format!("|{expression}| <= {bound}"));
    }

    pub fn assume_before_rounding(&mut self, number: Symbolic, bound: &str) {
        self.assume(&format!("{}x", Symbolic { negative: false, ..number }.name()), bound);
    }

    pub fn assume_exact(&mut self, number: Symbolic, bound: &str) {
        self.assume(&number.exact().expect("a number that stands for something"), bound);
    }

    /// The exact meaning of a number, by name.
    pub fn exact(&self, number: Symbolic) -> String {
        number.exact().expect("a number that stands for something")
    }

    /// Bounds the first term of a sum by what it stands for, for sums that cancel.
    pub fn expand_sums(&mut self, number: Symbolic) {
        let head = NODES.with_borrow(|nodes| nodes[number.node].terms[0]);
        let mut deviation = head.deviation();
        deviation.remove(&head.node);
        let (name, exact) = (head.name(), self.exact(head));
        self.hints.push(format!("{name}x -> {exact} + ({});", written(&deviation)));
    }

    /// The script that claims that `result` is within `bound` of `whole`, or of what it stands for; `step` is the
    /// difference of these two.
    pub fn claim(mut self, result: Double<Symbolic>, whole: Option<(String, String)>, bound: f64) -> String {
        let exact = result.hi.exact().expect("a number that stands for something");
        let mut deviation = Deviation::new();
        for half in [result.hi, result.lo] {
            accumulate(&mut deviation, &half.deviation(), None, half.negative);
        }
        line(&format!("R = {} + {};", result.hi.name(), result.lo.name()));
        self.hints.push(format!("R - {exact} -> {};", written(&deviation)));
        let goal = match whole {
            None => exact,
            Some((whole, step)) => {
                line(&format!("whole = {whole};"));
                self.hints.push(format!("R - whole -> (R - {exact}) + ({exact} - whole);"));
                self.hints.push(format!("{exact} - whole -> {step};"));
                "whole".to_owned()
            }
        };
        // Every double is a whole number of 2⁻¹⁰⁷⁴; the bounds are short ones of 2⁻¹⁶⁰.
        let scaled = bound * 2_f64.powi(160);
        assert_eq!(scaled.fract(), 0.0);
        let mut script = format!("# {}\n@rnd = float<ieee_64, ne>;\n", self.title);
        LINES.with_borrow(|lines| script.push_str(lines));
        let hypotheses = self.hypotheses.join("\n  /\\ ");
        write!(script, "{{ {hypotheses}\n  -> |R - {goal}| <= {scaled}b-160 }}\n{}\n", self.hints.join("\n"))
            .expect("a string takes everything");
        script
    }
}

/// The deviation as a sum of rounding errors with their factors.
fn written(deviation: &Deviation) -> String {
    let terms = deviation.iter().map(|(node, polynomial)| {
        let error = format!("(t{node} - t{node}x)");
        let monomials: Vec<_> = polynomial
            .iter()
            .map(|(monomial, count)| {
                let sign = if *count < 0 { "-" } else { "" };
                let product = if monomial.is_empty() { "1".to_owned() } else { monomial.join("*") };
                if count.abs() == 1 { format!("{sign}{product}") } else { format!("{count}*{product}") }
            })
            .collect();
        match monomials.join(" + ").as_str() {
            "1" => error,
            factor => format!("({factor})*{error}"),
        }
    });
    terms.collect::<Vec<_>>().join(" + ")
}
