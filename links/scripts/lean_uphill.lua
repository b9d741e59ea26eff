-- Lifts nodes with their distance from the foot of a slope, as terraces do.
return {
  id = "lean_uphill",
  label = "Lean uphill",
  doc = "Lifts a node with its distance in plan from the foot of a slope, so that a row of them rises like terraces.",
  params = {
    {id = "slope", default = 0.25, unit = "ratio", min = 0, soft_max = 1, doc = "Metres up for each metre away."},
    {id = "share", default = 0.2, unit = "ratio", min = 0, max = 1, doc = "Share of the difference that is made up for in a tick."},
  },
  reads = {
    foot = {at = "from", port = "node.position", unit = "m"},
    here = {at = "to", port = "node.position", unit = "m"},
  },
  proposes = {
    move = {at = "to", port = "node.position", unit = "m"},
  },
  evaluate = function(params, ends, tick)
    local way = ends.here - ends.foot
    local away = math.sqrt(way.x ^ 2 + way.y ^ 2)
    local missing = params.slope * away - way.z
    return {move = point(0, 0, params.share * missing)}
  end,
}
