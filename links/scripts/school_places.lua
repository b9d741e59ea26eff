-- Lets a school ask for as many places as the homes around it send pupils.
return {
  id = "school_places",
  label = "School places",
  doc = "Sums the floor area of homes and lets a school insist on the places that their children need, so that whatever shrinks the homes gives the school's space back.",
  params = {
    {id = "pupils", default = 1.2, min = 0, soft_max = 5, doc = "Pupils from each 100 m2 of homes."},
    {id = "place", default = 10, unit = "m2", min = 0, soft_max = 30, doc = "Floor area that a pupil needs, with corridors and halls."},
  },
  reads = {
    homes = {at = "from", port = "smart_volume.floor_area", unit = "m2", whole = true},
    storey = {at = "to", port = "smart_volume.storey_height", unit = "m"},
  },
  proposes = {
    least = {at = "to", port = "smart_volume.demand_min", unit = "m3"},
  },
  evaluate = function(params, ends, tick)
    local area = 0
    for _, home in ipairs(ends.homes) do
      area = area + home
    end
    return {least = area / 100 * params.pupils * params.place * ends.storey}
  end,
}
