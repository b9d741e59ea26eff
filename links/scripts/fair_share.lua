-- Gives all volumes of a set the same part of what there is, or parts by their rank.
return {
  id = "fair_share",
  label = "Fair share",
  doc = "Divides the number of a control among the volumes of a set: all alike, or the first ones by id more.",
  params = {
    {
      id = "rule",
      default = "alike",
      choices = {
        {id = "alike", doc = "Everybody gets the same."},
        {id = "by_rank", doc = "The second gets half of what the first gets, the third a third, and so on."},
      },
      doc = "How the parts are made.",
    },
  },
  reads = {
    total = {at = "from", port = "control.output", unit = "m3"},
    volumes = {at = "to", port = "node.id", whole = true},
  },
  proposes = {
    demands = {at = "to", port = "smart_volume.demand", unit = "m3", whole = true},
  },
  evaluate = function(params, ends, tick)
    local weights, sum = {}, 0
    for rank in ipairs(ends.volumes) do
      weights[rank] = params.rule == "alike" and 1 or 1 / rank
      sum = sum + weights[rank]
    end
    local demands = {}
    for rank, weight in ipairs(weights) do
      demands[rank] = ends.total * weight / sum
    end
    return {demands = demands}
  end,
}
