// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <boost/hana/cartesian_product.hpp>
#include <boost/hana/filter.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/type.hpp>
#include <boost/hana/unpack.hpp>
#include <tuple>

#include "contact/every_law.hpp"
#include "scarp/shape/particle_shape.hpp"

/// Every shape with every law around every law, as far as they make sense together.
namespace pairings {

namespace hana = boost::hana;

struct Bare {
  template <class Law>
  using Around = Law;
};
struct Rolling {
  template <class Law>
  using Around = scarp::RollingResistance<Law>;
};
struct Bonded {
  template <class Law>
  using Around = scarp::CohesiveBond<Law>;
};
struct BondedAndRolling {
  template <class Law>
  using Around = scarp::RollingResistance<scarp::CohesiveBond<Law>>;
};

inline constexpr auto contacts = hana::tuple_t<scarp::Frictionless, scarp::LinearFrictional, scarp::HertzMindlin<>,
                                               scarp::HertzMindlin<scarp::HertzRestitution>>;
/// One of several layers has what the layers are; alone they come nightly.
#ifdef SCARP_TESTS_NIGHTLY
inline constexpr auto wrappings = hana::tuple_t<Bare, Rolling, Bonded, BondedAndRolling>;
inline constexpr std::size_t laws_per_shape = 10;
#else
inline constexpr auto wrappings = hana::tuple_t<Bare, BondedAndRolling>;
inline constexpr std::size_t laws_per_shape = 5;
#endif

/// Not every law can be wrapped: a bond goes on using the law's springs where the law itself opens or slides, which
/// only springs of constant stiffness with friction allow. Nothing else is left out. Laws that want a radius of
/// curvature are let in with ellipses, superellipses and clumps, whose contact radius is nominal: the forces are then
/// no theory's, but they are still forces between two grains.
template <class Contact, class Wrapping>
concept MakesSense = requires {
  typename Wrapping::template Around<Contact>;
};
static_assert(MakesSense<scarp::LinearFrictional, BondedAndRolling>);
static_assert(!MakesSense<scarp::HertzMindlin<>, Bonded>, "springs that stiffen cannot be bonded");
static_assert(!MakesSense<scarp::Frictionless, Bonded>, "a bond needs a shear spring");

template <class ShapePolicy, class LawPolicy>
struct Pairing {
  using Shape = ShapePolicy;
  using Law = LawPolicy;
};

/// std::tuple of the pairings of some shapes, as doctest wants its lists of types.
template <class... Shapes>
constexpr auto of_shapes() {
  constexpr auto sensible = [](auto triple) {
    using Contact = typename decltype(+hana::at_c<1>(triple))::type;
    using Wrapping = typename decltype(+hana::at_c<2>(triple))::type;
    return hana::bool_c<MakesSense<Contact, Wrapping>>;
  };
  constexpr auto triples =
      hana::filter(hana::cartesian_product(hana::make_tuple(hana::tuple_t<Shapes...>, contacts, wrappings)), sensible);
  return hana::unpack(triples, [](auto... triple) {
    return std::tuple<Pairing<typename decltype(+hana::at_c<0>(triple))::type,
                              typename decltype(+hana::at_c<2>(triple))::type::template Around<
                                  typename decltype(+hana::at_c<1>(triple))::type>>...>{};
  });
}

template <class... Shapes>
using Of = decltype(of_shapes<Shapes...>());

}  // namespace pairings
