//! Law: what is stored comes back the same, and what could not have been stored is refused.
#![cfg(feature = "serde")]

use serde::{Serialize, de::DeserializeOwned};
use steradian::sprt::{
    Bernoulli, Bounds, Exponential, Family, Looks, Normal, Poisson, ResumeError, RunState, Sprt, Step,
};

type Failure = Box<dyn std::error::Error>;

fn test() -> Result<Sprt<Bernoulli>, Failure> {
    let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?);
    Ok(test.looks(Looks::from(10).every(2)).truncate(64))
}

fn through_text<T: Serialize + DeserializeOwned>(value: &T) -> Result<T, Failure> {
    Ok(serde_json::from_str(&serde_json::to_string(value)?)?)
}

/// A run that is put away at any place and taken up by its test, both through text, goes on as if it had not been.
fn is_resumed_to_the_bit<F>(test: Sprt<F>, observations: &[F::Observation]) -> Result<(), Failure>
where
    F: Family + PartialEq + Serialize + DeserializeOwned,
    F::Observation: Copy,
    F::Statistic: Serialize + DeserializeOwned,
{
    let stored: Sprt<F> = through_text(&test)?;
    assert!(stored == test);
    for cut in 0..=observations.len() {
        let mut whole = test.start();
        whole.extend(observations[..cut].iter().copied());
        let state = through_text(&whole.state())?;
        assert_eq!(state, whole.state());
        let mut resumed = stored.resume(state)?;
        assert!(resumed == whole, "{resumed:?} {whole:?}");
        for observation in &observations[cut..] {
            assert_eq!(resumed.push(*observation), whole.push(*observation), "cut at {cut}");
            assert_eq!(resumed.log_likelihood_ratio().to_bits(), whole.log_likelihood_ratio().to_bits());
        }
    }
    Ok(())
}

#[test]
fn a_run_of_any_family_can_be_put_away_and_taken_up() -> Result<(), Failure> {
    let outcomes = [1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 1, 1, 1].map(|outcome| outcome == 1);
    is_resumed_to_the_bit(test()?, &outcomes)?;
    let reals = [0.7, 0.1, 1.3, 0.2, 0.9, 1e-17, 0.4, 1.1, 0.1, 0.3, 2.7, 0.6];
    let bounds = Bounds::from_ratios(7.0, 0.1)?;
    is_resumed_to_the_bit(Sprt::new(Normal::new(0.1, 0.9, 1.7)?, bounds).truncate(9), &reals)?;
    is_resumed_to_the_bit(Sprt::new(Exponential::new(1.3, 2.0)?, bounds).looks(Looks::from(3).every(4)), &reals)?;
    let counts = [1, 0, 3, 2, 1, 1, 0, 2, 4, 1, 0, 5];
    is_resumed_to_the_bit(Sprt::new(Poisson::new(1.5, 1.1)?, bounds), &counts)?;
    // A run that can no longer decide is stored as well.
    is_resumed_to_the_bit(Sprt::new(Normal::new(0.1, 0.9, 1.7)?, bounds).truncate(5), &[0.5, f64::NAN, 1.0, 2.0])?;
    is_resumed_to_the_bit(Sprt::new(Exponential::new(1.3, 2.0)?, bounds), &[0.5, -1.0, 1.0])
}

#[test]
fn a_postponed_look_is_remembered() -> Result<(), Failure> {
    let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?);
    for (trials, step) in [(9, Some(Step::Continue)), (14, None)] {
        let mut run = test.start();
        let stopped = run.push_counts(4, trials)?; // rejects at 9, goes on at 14
        assert_eq!(stopped == Step::Continue, step.is_none());
        let resumed = test.resume(through_text(&run.state())?)?;
        assert_eq!(resumed, run);
        let mut other = run;
        assert_eq!((other.push(true), other.inference().is_err()), {
            let mut resumed = resumed;
            (resumed.push(true), resumed.inference().is_err())
        });
    }
    Ok(())
}

#[test]
fn a_state_of_another_test_is_refused() -> Result<(), Failure> {
    let test = test()?;
    let state = test.decide([true, false, false]).state();
    let (family, bounds) = (*test.family(), *test.bounds());
    let other = |family, bounds| Sprt::new(family, bounds).looks(Looks::from(10).every(2)).truncate(64);
    assert!(other(family, bounds).resume(state).is_ok());
    for foreign in [
        test.truncate(65),
        test.looks(Looks::from(10).every(3)),
        test.looks(Looks::from(11).every(2)),
        other(Bernoulli::new(0.1, 0.31)?, bounds),
        other(Bernoulli::new(0.3, 0.1)?, bounds),
        other(family, Bounds::from_risks(0.05, 0.11)?),
        other(family, Bounds::from_ratios(0.05_f64.recip(), 0.1)?),
    ] {
        assert_eq!(foreign.resume(state), Err(ResumeError::Test));
    }
    // The statistics of both are counts, and the numbers of both families the same.
    let counts = Sprt::new(Poisson::new(0.1, 0.3)?, bounds).looks(Looks::from(10).every(2)).truncate(64);
    assert!(matches!(counts.resume(state), Err(ResumeError::Test)));
    Ok(())
}

#[test]
fn what_could_not_have_been_stored_is_refused() -> Result<(), Failure> {
    assert!(serde_json::from_str::<Bernoulli>(r#"{"p0":0.5,"p1":0.5}"#).is_err());
    assert!(serde_json::from_str::<Bounds>(r#"{"risks":{"alpha":0.5,"beta":0.5}}"#).is_err());
    assert_eq!(serde_json::from_str::<Looks>(r#"{"first":0,"step":0}"#)?, Looks::default());
    let test = test()?;
    let text = serde_json::to_value(test.start().state())?;
    let resumed = |samples: u64, statistic: u64, step: &str, postponed: bool| {
        let mut text = text.clone();
        text["samples"] = samples.into();
        text["statistic"] = statistic.into();
        text["step"] = serde_json::from_str(step).expect("a step");
        text["postponed"] = postponed.into();
        test.resume(serde_json::from_value::<RunState<u64>>(text).expect("a state"))
    };
    for (samples, successes) in [(3, 4), (0, 1), (u64::MAX, 5), (1 << 60, 5)] {
        assert_eq!(
            resumed(samples, successes, r#""Continue""#, false),
            Err(ResumeError::Statistic { samples }),
            "{samples} {successes}"
        );
    }
    for (samples, successes, step, postponed) in [
        (64, 12, r#""Continue""#, false),
        (12, 12, r#""Continue""#, false),
        (5, 2, r#""Continue""#, true),
        (12, 12, r#"{"Stop":"AcceptH0"}"#, false),
        (4, 4, r#"{"Stop":"RejectH0"}"#, false),
        (11, 11, r#"{"Stop":"RejectH0"}"#, false),
        (63, 10, r#""Exhausted""#, false),
        (65, 12, r#""Exhausted""#, false),
    ] {
        let got = resumed(samples, successes, step, postponed);
        assert!(matches!(got, Err(ResumeError::Step { .. })), "{samples} {successes} {step} {got:?}");
    }
    assert!(resumed(12, 12, r#"{"Stop":"RejectH0"}"#, false).is_ok());
    assert!(resumed(11, 11, r#"{"Stop":"RejectH0"}"#, true).is_ok());
    assert!(resumed(64, 12, r#""Exhausted""#, false).is_ok());
    let times = Sprt::new(Exponential::new(1.0, 2.0)?, *test.bounds());
    let mut text = serde_json::to_value(times.decide([1.0]).state())?;
    text["statistic"][0] = (-1.0_f64).to_bits().into();
    let state = serde_json::from_value(text)?;
    assert!(matches!(times.resume(state), Err(ResumeError::Statistic { samples: 1 })));
    Ok(())
}
